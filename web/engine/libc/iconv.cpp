// SPDX-License-Identifier: BSD-3-Clause
#include <iconv.h>

/// In place of that of the C library, whose tables of Chinese and Japanese alphabets are a seventh of the page: files reach
/// the engine in UTF-8, the browser has read them (src/bed/files.ts).
extern "C" {
iconv_t iconv_open(const char*, const char*) { return iconv_t(-1); }
size_t iconv(iconv_t, char**, size_t*, char**, size_t*) { return static_cast<size_t>(-1); }
int iconv_close(iconv_t) { return 0; }
}
