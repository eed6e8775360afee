// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

/// What a fuzz target gives to replay.cpp besides LLVMFuzzerTestOneInput().
namespace shearfront::fuzz {

/// Texts to start from, in an order that is the same on every machine.
[[nodiscard]] std::vector<std::string> corpus();
/// Pieces of text that mutations insert.
[[nodiscard]] std::vector<std::string> words();

/// The input files of the command-line cases whose name ends like this, sorted.
[[nodiscard]] std::vector<std::string> files_of_cases(const std::string& extension);

}  // namespace shearfront::fuzz
