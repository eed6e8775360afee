// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

namespace shearfront {

/// A result file that is either complete or not there: it is written beside its target and renamed by
/// commit(). "-" is standard output; devices and pipes are written directly.
///
/// Guaranteed: until commit() an existing target keeps its content; without commit() nothing is left behind.
/// Errors: FileError, "out.csv: cannot be written: No space left on device", from every member; the
/// constructor already refuses a target that cannot be created.
class OutputFile {
 public:
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;

  void write(std::string_view text);
  void commit();
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] bool is_stdout() const { return path_ == "-"; }

 private:
  struct Closer {
    void operator()(std::FILE* file) const {
      if (file != stdout) std::fclose(file);
    }
  };
  using File = std::unique_ptr<std::FILE, Closer>;
  File create_temporary();
  void open();
  [[noreturn]] void fail(int error) const;

  std::string path_;       ///< as given by the user
  std::string target_;     ///< where symbolic links lead to
  std::string temporary_;  ///< empty: written directly
  bool is_direct_ = false;
  File file_;
};

}  // namespace shearfront
