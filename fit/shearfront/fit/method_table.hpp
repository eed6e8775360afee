// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/io/detail/toml_source.hpp"
#include "shearfront/solver/method.hpp"

namespace shearfront::fit {

/// Reads the table [forward]: method, and every option of that solver, as on the command line with _ for -. Options of
/// other solvers are checked and change nothing. With a scene the method prefers what is smooth in its numbers, unless the
/// table says otherwise. What is wrong goes into the report of the table.
void read_method(detail::TableReader& table, Method& method, const Scene<double>* scene);

}  // namespace shearfront::fit
