// SPDX-License-Identifier: BSD-3-Clause
#include "answer.hpp"

#include <emscripten.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace shearfront::web {

void Answer::add(const std::optional<double>& x) {
  add(x.value_or(std::numeric_limits<double>::quiet_NaN()));
}

void Answer::line(std::string_view text_line) {
  std::string clean(text_line);
  std::replace(clean.begin(), clean.end(), '\n', ' ');
  text += clean + '\n';
}

Answer& answer() {
  static Answer last;
  return last;
}

Work& work() {
  static Work now;
  return now;
}

}  // namespace shearfront::web

extern "C" {
EMSCRIPTEN_KEEPALIVE void* sf_allocate(std::size_t bytes) { return std::malloc(bytes); }
EMSCRIPTEN_KEEPALIVE void sf_free(void* memory) { std::free(memory); }
EMSCRIPTEN_KEEPALIVE const double* sf_numbers() { return shearfront::web::answer().numbers.data(); }
EMSCRIPTEN_KEEPALIVE std::size_t sf_n_numbers() { return shearfront::web::answer().numbers.size(); }
EMSCRIPTEN_KEEPALIVE const char* sf_text() { return shearfront::web::answer().text.data(); }
EMSCRIPTEN_KEEPALIVE std::size_t sf_n_text() { return shearfront::web::answer().text.size(); }
}
