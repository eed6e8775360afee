// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/output_file.hpp"

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "shearfront/io/detail/text_source.hpp"

namespace shearfront {
namespace fs = std::filesystem;

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
  std::error_code error;
  if (is_stdout()) {
    is_direct_ = true;
    return;
  }
  const fs::file_status status = fs::status(path_, error);
  if (path_.empty()) fail(ENOENT);
  if (fs::is_directory(status)) fail(EISDIR);
  target_ = fs::is_symlink(path_, error) ? fs::weakly_canonical(path_, error).string() : path_;
  is_direct_ = fs::exists(status) && !fs::is_regular_file(status);
  if (is_direct_ || fs::exists(status)) {
    if (!File(std::fopen(target_.c_str(), is_direct_ ? "wb" : "r+b"))) fail(errno);
  }
  if (is_direct_) return;
  // Tell now, and not after a long computation, that the file cannot be created.
  create_temporary().reset();
  fs::remove(std::exchange(temporary_, {}), error);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      is_direct_(other.is_direct_),
      file_(std::move(other.file_)) {}

OutputFile::~OutputFile() {
  file_.reset();
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

OutputFile::File OutputFile::create_temporary() {
  constexpr int kMostAttempts = 1000;  // names taken by other runs, or left behind by killed ones
  for (int i = 0; i < kMostAttempts; ++i) {
    temporary_ = target_ + ".part" + (i == 0 ? "" : std::to_string(i));
    if (File file{std::fopen(temporary_.c_str(), "wbx")}) return file;
    if (errno != EEXIST) break;
  }
  temporary_.clear();
  fail(errno);
}

void OutputFile::open() {
  if (is_direct_) {
    file_.reset(is_stdout() ? stdout : std::fopen(target_.c_str(), "wb"));
    if (!file_) fail(errno);
    return;
  }
  file_ = create_temporary();
  std::error_code error;
  if (const fs::file_status status = fs::status(target_, error); fs::exists(status))
    fs::permissions(temporary_, status.permissions(), error);
}

void OutputFile::write(std::string_view text) {
  if (!file_) open();
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail(errno);
}

void OutputFile::commit() {
  if (!file_) open();
  if (std::fflush(file_.get()) != 0) fail(errno);
  std::FILE* file = file_.release();
  if (file != stdout && std::fclose(file) != 0) fail(errno);
  if (temporary_.empty()) return;
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) fail(error.value());
  temporary_.clear();
}

void OutputFile::fail(int error) const {
  detail::throw_file_error(is_stdout()     ? "standard output"
                           : path_.empty() ? "\"\""
                                           : path_,
                           "cannot be written: " + std::generic_category().message(error));
}

}  // namespace shearfront
