// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/observations_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "shearfront/io/detail/observation_rows.hpp"
#include "shearfront/io/detail/observation_sizes.hpp"
#include "shearfront/io/detail/replicates.hpp"
#include "shearfront/io/detail/table_lines.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/scene/state_range.hpp"

namespace shearfront {
namespace {

using detail::CsvField;
using detail::name_of;
using detail::ObservationColumns;
using detail::SimulationCode;
using detail::TextSource;

/// The format for measurements of a steady chute, or of what may be one.
ObservationFormat format_for(bool is_chute, ObservationFormat format) {
  format.is_chute = is_chute;
  return format;
}

/// Reads the lines of a file, and checks what they say together.
class ObservationsReader : detail::ObservationRows {
 public:
  using ObservationRows::ObservationRows;
  ObservationsReader(const TextSource& source, const Scene<double>& scene, const ObservationFormat& format)
      : ObservationRows(source, scene.bottom(), scene.top(), format_for(scene.is_chute(), format)) {
    phi_ = phi_range(scene);
    target_ = {scene.spec().units.z, scene.spec().units.t, phi_->lowest == 0 && phi_->highest <= 1};
  }

  Observations read() {
    const std::string_view text = source_.text();
    for (std::size_t begin = 0; begin < text.size();) {
      const std::string_view line = detail::line_at(text, begin);
      read_line(begin, line);
      begin += line.size() + 1;
    }
    if (!columns_) {
      report_.add({1, 1}, {"header", "", "missing; must name the columns, such as t,z,phi"});
    } else if (n_rows_ == 0) {
      report_.add({1, 1}, {"rows", "", "missing; must follow the header"});
    } else if (result_.rows.empty() && result_.n_missing > 0 && report_.is_empty()) {
      report_.add(columns_->position(columns_->value()),
                  {std::string(name_of(columns_->value())), "",
                   fmt::format("missing in every row ({}); must be there in one at least", n_rows_)});
    }
    check_sigma();
    check_places();
    check_sizes();
    report_.throw_if_any();
    for (std::string& remark : detail::remarks_on_sizes(result_, phi_, top_ - bottom_))
      result_.notes.push_back(printable(source_.name()) + ": " + remark);
    say_what_was_understood();
    return std::move(result_);
  }

 private:
  void read_line(std::size_t offset, std::string_view line) {
    const std::string_view content = detail::trimmed(line);
    if (content.empty() || offset == dialect_.units) return;
    const bool is_header = dialect_.is_simulated() && offset == dialect_.header,
               is_comment = content[0] == '#' && !is_header;
    if (is_comment || offset < dialect_.header) {
      const std::size_t mark = !is_comment ? 0 : content.starts_with("# ") ? 2 : 1;
      result_.comments.emplace_back(content.substr(mark));
      if (!is_comment) ++n_preamble_;
      return;
    }
    if (dialect_.is_simulated() && !is_header && !is_row(offset, line)) return;
    const auto bad_quotes = take_apart(offset, line, fields_);
    if (bad_quotes)
      report_.add(
          source_.position(offset + *bad_quotes),
          {columns_ ? fmt::format("row[{}]", n_rows_) : "header", "",
           fmt::format("must close its quotes on the same line, before a {}", dialect_.separator_name())});
    if (columns_) {
      // Spreadsheets end in rows of separators.
      const auto is_blank = [](const CsvField& field) { return field.text.empty(); };
      if (!bad_quotes && fields_.size() > 1 && std::all_of(fields_.begin(), fields_.end(), is_blank)) return;
      if (!bad_quotes) read_row(offset);
      ++n_rows_;
      return;
    }
    if (!bad_quotes) {
      std::vector<CsvField> units;
      if (dialect_.units)
        (void)detail::split_csv(detail::line_at(source_.text(), *dialect_.units), units, dialect_.separator);
      columns_.emplace(source_, offset, fields_, units, format_, dialect_.layout, target_, report_);
      if (dialect_.code == SimulationCode::lammps && !format_.time_step)
        report_.add(source_.position(offset),
                    {"Timestep", "", "needs time_step in [format] or --time-step, the time of one step"});
    }
    report_.throw_if_any();  // without a header nothing is known about the rows
    result_.quantity = columns_->quantity();
    if (format_.width) {
      if (result_.quantity != Quantity::point)
        report_.add(
            columns_->position(columns_->value()),
            {"width", number_text(*format_.width), "must not be given beside a column that says it, M or H"});
      result_.quantity = Quantity::bin;
      width_ = *format_.width * columns_->factor(Column::z);
    }
    result_.units = columns_->units();
    result_.units.is_chute = columns_->is_distance();
    // MercuryDPM writes up to 80 columns.
    const bool has_many = dialect_.is_simulated() && dialect_.code != SimulationCode::lammps;
    if (!has_many) result_.notes = columns_->notes();
  }

  /// Of what a particle code wrote.
  bool is_row(std::size_t offset, std::string_view line) {
    const auto kind = simulation_.take(line);
    if (kind == detail::SimulationRows::Line::bad)
      report_.add(source_.position(offset),
                  {"block", quoted_text(line), std::string(simulation_.constraint())});
    return kind == detail::SimulationRows::Line::row;
  }

  void check_sigma() {
    if (std::none_of(result_.rows.begin(), result_.rows.end(),
                     [](const Observation& o) { return o.sigma > 0; }))
      return;
    for (std::size_t i = 0; i < result_.rows.size(); ++i)
      if (!(result_.rows[i].sigma > 0))
        report_.add(position_of(origins_[i], Column::sigma),
                    {fmt::format("sigma[{}]", origins_[i].row), "",
                     "missing; must be given in every row that has a value, or in none"});
  }

  void check_places() {
    if (!columns_ || format_.replicates == Replicates::kept) return;
    if (format_.replicates == Replicates::averaged) return average();
    const Column at = columns_->has(Column::z) ? Column::z : Column::t;
    const char* const of_same = at == Column::t                ? ""
                                : columns_->has(Column::width) ? ", which has the same t and width"
                                                               : ", which has the same t";
    const char* hint = "; or be kept or averaged by replicates = \"keep\" or \"mean\"";  // once
    for (const detail::RepeatedPlace& place : detail::repeated_places(result_.rows)) {
      const Origin& again = origins_[place.row];
      const Observation& row = result_.rows[place.row];
      report_.add(position_of(again, at), {fmt::format("{}[{}]", name_of(at), again.row),
                                           number_text(at == Column::z ? row.z : row.t),
                                           fmt::format("must differ from {} of line {}{}{}", name_of(at),
                                                       source_.position(origins_[place.first].offset).line,
                                                       of_same, std::exchange(hint, ""))});
    }
  }

  void average() {
    const std::size_t n_values = result_.rows.size();
    const detail::Means means = detail::average_replicates(result_.rows);
    if (means.kept.size() == n_values && means.spread == 0) return;  // a value a place
    if (!std::isfinite(means.spread)) {
      const Column value = columns_->value();
      report_.add(position_of(origins_[means.kept[0]], value),
                  {std::string(name_of(value)), number_text(result_.rows[means.kept[0]].value),
                   "must be among values that differ by less than 1e308, to be averaged"});
      return;
    }
    for (std::size_t i = 0; i < means.kept.size(); ++i) origins_[i] = origins_[means.kept[i]];
    origins_.resize(means.kept.size());
    averaged_ = fmt::format("means of {} values at {} places, which scatter by {}", n_values,
                            means.kept.size(), number_text(means.spread, 3));
  }

  void say_what_was_understood() {
    const std::vector<std::string> parts = dialect_.remarks(source_.encoding(), n_preamble_);
    const bool is_plain = parts.empty() && columns_->is_plain() && averaged_.empty() && width_ == 0;
    std::string text =
        fmt::format("{}: {} row{}", printable(source_.name()), n_rows_, n_rows_ == 1 ? "" : "s");
    for (const std::string& part : parts) text += ", " + part;
    text += "; " + columns_->understood();
    if (width_ > 0) text += fmt::format("; means over bins of width {}", number_text(width_));
    if (result_.n_missing > 0) text += fmt::format("; {} missing", result_.n_missing);
    if (!averaged_.empty()) text += "; " + averaged_;
    if (!is_plain) result_.notes.insert(result_.notes.begin(), text);
    result_.understood = std::move(text);
  }

  void check_sizes() {
    if (!phi_ || !columns_) return;
    const Column value = columns_->value();
    const auto add_value = [&](const detail::ImplausibleValue& found) {
      report_.add(position_of(origins_[found.row], value),
                  {fmt::format("{}[{}]", name_of(value), origins_[found.row].row),
                   number_text(result_.rows[found.row].value), found.constraint});
    };
    for (const auto& found : detail::impossible_values(result_, *phi_, top_ - bottom_)) add_value(found);
    if (!target_.are_parts || !report_.is_empty()) return;
    if (const auto found = detail::undeclared_percent(result_)) add_value(*found);
  }

  ObservationColumns::Target target_;
  std::optional<StateRange<double>> phi_;  ///< that the scene allows, if there is one
  std::size_t n_preamble_ = 0;             ///< lines before the header that are no comments
  std::string averaged_;                   ///< what was averaged, in words
};

}  // namespace

Observations read_observations(const std::string& path, double bottom, double top,
                               const ObservationFormat& format) {
  return ObservationsReader(TextSource::read_decoded(path), bottom, top, format_for(true, format)).read();
}

Observations read_observations(const std::string& path, const Scene<double>& scene,
                               const ObservationFormat& format) {
  return ObservationsReader(TextSource::read_decoded(path), scene, format).read();
}

Observations parse_observations(std::string text, const std::string& file, double bottom, double top,
                                const ObservationFormat& format) {
  return ObservationsReader(TextSource::decode(file, std::move(text)), bottom, top, format_for(true, format))
      .read();
}

Observations parse_observations(std::string text, const std::string& file, const Scene<double>& scene,
                                const ObservationFormat& format) {
  return ObservationsReader(TextSource::decode(file, std::move(text)), scene, format).read();
}

}  // namespace shearfront
