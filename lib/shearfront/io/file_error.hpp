// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <utility>

#include "shearfront/model/complaint.hpp"

namespace shearfront {

/// A file that cannot be used: bad input whose complaints are located in a file.
///
/// what() is the finished report, one line per complaint in the order of the file:
///     scene.toml:7:10: shear_rate.values[1] = -0.31; must be > 0
/// Lines and columns count from 1, columns in characters (Unicode code points), not bytes.
class FileError : public InputError {
 public:
  FileError(Complaints complaints, std::string report)
      : InputError(std::move(complaints)), report_(std::move(report)) {}

  [[nodiscard]] const char* what() const noexcept override { return report_.c_str(); }

 private:
  std::string report_;
};

}  // namespace shearfront
