// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/observations_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "shearfront/io/detail/cell_text.hpp"
#include "shearfront/io/detail/dialect.hpp"
#include "shearfront/io/detail/observation_columns.hpp"
#include "shearfront/io/detail/observation_sizes.hpp"
#include "shearfront/io/detail/replicates.hpp"
#include "shearfront/io/detail/table_lines.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/scene/state_range.hpp"

namespace shearfront {
namespace {

using detail::ComplaintReport;
using detail::CsvField;
using detail::Dialect;
using detail::name_of;
using detail::ObservationColumns;
using detail::Position;
using detail::SimulationCode;
using detail::TextSource;

/// The format for measurements of a steady chute, or of what may be one.
ObservationFormat format_for(bool is_chute, ObservationFormat format) {
  format.is_chute = is_chute;
  return format;
}

class ObservationsReader {
 public:
  ObservationsReader(const TextSource& source, double bottom, double top, const ObservationFormat& format)
      : source_(source),
        dialect_(dialect_of(source, format)),
        format_(detail::format_of(dialect_.code, format)),
        simulation_(dialect_.code),
        report_(source.name(), kMostComplaints),
        bottom_(bottom),
        top_(top) {}
  ObservationsReader(const TextSource& source, const Scene<double>& scene, const ObservationFormat& format)
      : ObservationsReader(source, scene.bottom(), scene.top(), format_for(scene.is_chute(), format)) {
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
  /// A number of the result: where it came from.
  struct Origin {
    std::size_t row, offset, field;
  };

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

  /// The fields of a line, with the time that stands above it.
  std::optional<std::size_t> take_apart(std::size_t offset, std::string_view line,
                                        std::vector<CsvField>& fields) const {
    const auto bad_quotes = detail::split_csv(line, fields, dialect_.separator);
    simulation_.complete(fields, offset == dialect_.header);
    return bad_quotes;
  }
  /// Of what a particle code wrote.
  bool is_row(std::size_t offset, std::string_view line) {
    const auto kind = simulation_.take(line);
    if (kind == detail::SimulationRows::Line::bad)
      report_.add(source_.position(offset),
                  {"block", quoted_text(line), std::string(simulation_.constraint())});
    return kind == detail::SimulationRows::Line::row;
  }

  void read_row(std::size_t offset) {
    if (fields_.size() != columns_->n_fields()) {
      add(offset, "row", fmt::format("({} field{})", fields_.size(), fields_.size() == 1 ? "" : "s"),
          fmt::format("must have {} ({})", columns_->n_fields(), columns_->names()));
      return;
    }
    Observation o;
    if (columns_->layout() == TableLayout::rows) {
      const bool has_place = !columns_->has(Column::z) || read_place(offset, o);
      const bool is_good = read_time(offset, o) && has_place;
      read_value(offset, columns_->field(columns_->value()), o, is_good);
      return;
    }
    const bool by_height = columns_->layout() == TableLayout::heights;
    bool is_good = by_height ? read_time(offset, o) : read_place(offset, o);
    for (const auto& [field, place] : columns_->places()) {
      if (by_height) {
        o.z = place * columns_->factor(Column::z);
        if (!set_width(offset, o)) continue;
        if (n_rows_ == 0 && !(o.z >= bottom_ && o.z <= top_))
          is_good = refuse_place(field, Column::z, place, "must be inside the domain " + domain());
      } else {
        o.t = place * columns_->factor(Column::t);
        if (n_rows_ == 0 && !(o.t >= 0)) is_good = refuse_place(field, Column::t, place, "must be >= 0");
      }
      read_value(offset, field, o, is_good);
    }
  }

  bool read_time(std::size_t offset, Observation& o) {
    if (!read_number(offset, Column::t, o.t)) return false;
    if (dialect_.code == SimulationCode::lammps) o.t *= format_.time_step.value_or(1);
    return o.t >= 0 || refuse(offset, Column::t, "must be >= 0");
  }

  /// The value of an observation whose place is read; `is_good`: and is right.
  void read_value(std::size_t offset, std::size_t field, Observation o, bool is_good) {
    const Column column = columns_->value();
    const bool has_value = !detail::is_missing(fields_[field].text, format_.missing);
    if (has_value)
      is_good = read_number(offset, column, field, o.value, ", or empty or NA if it is missing") && is_good;
    if (column == Column::phi_large) o.value = 1 - o.value;
    if (has_value && is_good && columns_->has(Column::H) && !(o.value > 0))
      is_good = refuse(offset, Column::H, "must be > 0");
    is_good = read_sigma(offset, o) && is_good;
    if (!has_value) {
      ++result_.n_missing;
    } else if (is_good) {
      result_.rows.push_back(o);
      origins_.push_back({n_rows_, offset, field});
    }
  }

  bool read_place(std::size_t offset, Observation& o) {
    bool is_good = read_number(offset, Column::z, o.z);
    if (is_good && !(o.z >= bottom_ && o.z <= top_))
      is_good = refuse(offset, Column::z, "must be inside the domain " + domain());
    if (!columns_->has(Column::width)) return is_good && set_width(offset, o);
    if (!read_number(offset, Column::width, o.width)) return false;
    if (!(o.width > 0)) return refuse(offset, Column::width, "must be > 0");
    if (is_good && !is_bin_resolved(o.z, o.width))
      return refuse(offset, Column::width,
                    fmt::format("must be at least {} of z", number_text(kLeastBinWidth)));
    if (!is_good || is_bin_inside(o.z, o.width, bottom_, top_)) return is_good;
    return refuse(offset, Column::width,
                  fmt::format("must leave the bin z -+ width/2 = [{}, {}] inside the domain {}",
                              number_text(o.z - o.width / 2), number_text(o.z + o.width / 2), domain()));
  }

  /// The width that the format gives to all bins.
  bool set_width(std::size_t offset, Observation& o) {
    o.width = width_;
    if (width_ == 0 || (is_bin_resolved(o.z, width_) && is_bin_inside(o.z, width_, bottom_, top_)))
      return true;
    add(offset, "z", number_text(o.z),
        fmt::format("must leave its bin of width {} inside the domain {}", number_text(width_), domain()));
    return false;
  }

  bool read_sigma(std::size_t offset, Observation& o) {
    if (!columns_->has(Column::sigma) ||
        detail::is_missing(fields_[columns_->field(Column::sigma)].text, format_.missing))
      return true;
    if (!read_number(offset, Column::sigma, o.sigma)) return false;
    return o.sigma > 0 || refuse(offset, Column::sigma, "must be > 0");
  }

  bool read_number(std::size_t offset, Column column, double& x) {
    return read_number(offset, column, columns_->field(column), x, "");
  }
  bool read_number(std::size_t offset, Column column, std::size_t field, double& x,
                   std::string_view alternative) {
    const std::string_view text = fields_[field].text;
    if (const auto number = detail::number_with_mark(text, dialect_.decimal)) {
      x = *number * columns_->factor(column);
      return true;
    }
    return refuse(offset, column, field,
                  detail::why_no_number(text, dialect_.decimal) + std::string(alternative));
  }

  /// Notes what is wrong with a field of the row that is being read; false for convenience.
  bool refuse(std::size_t offset, Column column, std::string constraint) {
    return refuse(offset, column, columns_->field(column), std::move(constraint));
  }
  bool refuse(std::size_t offset, Column column, std::size_t at, std::string constraint) {
    const CsvField& field = fields_[at];
    add(offset + field.offset, std::string(name_of(column)), detail::shown_number(field.text),
        std::move(constraint));
    return false;
  }
  /// The same for a place that stands in the header of a wide table.
  bool refuse_place(std::size_t field, Column column, double place, std::string constraint) {
    report_.add(position_in(dialect_.header, field),
                {std::string(name_of(column)), number_text(place), std::move(constraint)});
    return false;
  }

  void add(std::size_t offset, const std::string& key, std::string value, std::string constraint) {
    report_.add(source_.position(offset),
                {fmt::format("{}[{}]", key, n_rows_), std::move(value), std::move(constraint)});
  }

  [[nodiscard]] std::string domain() const {
    return fmt::format("[{}, {}]", number_text(bottom_), number_text(top_));
  }

  /// Where a field of a row of the result stands.
  [[nodiscard]] Position position_of(const Origin& origin, Column column) {
    const bool is_of_row = columns_->has(column) && column != columns_->value();
    return position_in(origin.offset, is_of_row ? columns_->field(column) : origin.field);
  }
  [[nodiscard]] Position position_in(std::size_t line, std::size_t field) const {
    std::vector<CsvField> fields;
    (void)take_apart(line, detail::line_at(source_.text(), line), fields);
    return source_.position(line + fields[field].offset);
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

  const TextSource& source_;
  Dialect dialect_;
  ObservationFormat format_;
  detail::SimulationRows simulation_;
  ComplaintReport report_;
  double bottom_, top_;
  ObservationColumns::Target target_;
  std::optional<StateRange<double>> phi_;  ///< that the scene allows, if there is one
  std::optional<ObservationColumns> columns_;
  std::vector<CsvField> fields_;  ///< of the line that is being read
  std::size_t n_rows_ = 0;        ///< read so far; the number of the row that is being read
  double width_ = 0;              ///< of every bin, from the format; 0: from a column or none
  std::size_t n_preamble_ = 0;    ///< lines before the header that are no comments
  std::string averaged_;          ///< what was averaged, in words
  Observations result_;
  std::vector<Origin> origins_;  ///< of result_.rows
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
