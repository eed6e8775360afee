// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/observations_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "shearfront/io/detail/dialect.hpp"
#include "shearfront/io/detail/observation_columns.hpp"
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

constexpr double kPlausiblePhi = 2;  // beyond it phi is no fraction with noise, but probably in percent
/// A value this many times farther off than any that is possible is no measurement with noise.
constexpr double kImpossible = 1000;

constexpr std::array<std::string_view, 9> kMissing{"NA",  "N/A",  "n/a",  "na", "NaN",
                                                   "nan", "#N/A", "NULL", "-"};

/// Why parse_number() refuses the text.
std::string_view why_no_number(std::string_view text) {
  if (!text.empty() && text[0] == '+') text.remove_prefix(1);
  const ReadNumber read = read_number(text);
  if (text.empty() || read.length != text.size()) return "must be a number";
  return read.error == std::errc::result_out_of_range
             ? "must be 0 or between 5e-324 and 1.7976931348623157e308 in size"
             : "must be a finite number";
}

auto place_of(const Observation& o) { return std::tie(o.t, o.z, o.width); }

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
      : ObservationsReader(source, scene.bottom(), scene.top(), format) {
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
    note_range();
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
      report_.add(source_.position(offset + *bad_quotes),
                  {columns_ ? fmt::format("row[{}]", n_rows_) : "header", "",
                   fmt::format("must close its quotes on the same line, before a {}", separator())});
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
    if (!read_number(offset, Column::t, o.t, "")) return false;
    if (dialect_.code == SimulationCode::lammps) o.t *= format_.time_step.value_or(1);
    return o.t >= 0 || refuse(offset, Column::t, "must be >= 0");
  }

  /// The value of an observation whose place is read; `is_good`: and is right.
  void read_value(std::size_t offset, std::size_t field, Observation o, bool is_good) {
    const Column column = columns_->value();
    const bool has_value = !is_missing(fields_[field].text);
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
    bool is_good = read_number(offset, Column::z, o.z, "");
    if (is_good && !(o.z >= bottom_ && o.z <= top_))
      is_good = refuse(offset, Column::z, "must be inside the domain " + domain());
    if (!columns_->has(Column::width)) return is_good && set_width(offset, o);
    if (!read_number(offset, Column::width, o.width, "")) return false;
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
    if (!columns_->has(Column::sigma) || is_missing(fields_[columns_->field(Column::sigma)].text))
      return true;
    if (!read_number(offset, Column::sigma, o.sigma, "")) return false;
    return o.sigma > 0 || refuse(offset, Column::sigma, "must be > 0");
  }

  bool read_number(std::size_t offset, Column column, double& x, std::string_view alternative) {
    return read_number(offset, column, columns_->field(column), x, alternative);
  }
  bool read_number(std::size_t offset, Column column, std::size_t field, double& x,
                   std::string_view alternative) {
    const std::string_view text = fields_[field].text;
    if (const auto number = detail::number_with_mark(text, dialect_.decimal)) {
      x = *number * columns_->factor(column);
      return true;
    }
    const bool is_other_mark = dialect_.decimal == ',' && parse_number(text);
    return refuse(offset, column, field,
                  std::string(text.empty() ? "missing; " : "") +
                      (is_other_mark ? "must have a decimal comma, as other numbers of the file do"
                                     : std::string(why_no_number(text))) +
                      std::string(alternative));
  }

  [[nodiscard]] bool is_missing(std::string_view text) const {
    return text.empty() || std::find(kMissing.begin(), kMissing.end(), text) != kMissing.end() ||
           std::find(format_.missing.begin(), format_.missing.end(), text) != format_.missing.end();
  }

  /// Notes what is wrong with a field of the row that is being read; false for convenience.
  bool refuse(std::size_t offset, Column column, std::string constraint) {
    return refuse(offset, column, columns_->field(column), std::move(constraint));
  }
  bool refuse(std::size_t offset, Column column, std::size_t at, std::string constraint) {
    const CsvField& field = fields_[at];
    add(offset + field.offset, std::string(name_of(column)), shown(field.text), std::move(constraint));
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

  static std::string shown(std::string_view text) {
    if (text.empty()) return {};
    return why_no_number(text) == "must be a number" ? quoted_text(text) : printable(text, kLongestShown);
  }

  [[nodiscard]] std::string domain() const {
    return fmt::format("[{}, {}]", number_text(bottom_), number_text(top_));
  }

  [[nodiscard]] std::string_view separator() const {
    return dialect_.separator == ';' ? "semicolon" : dialect_.separator == '\t' ? "tab" : "comma";
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

  /// Finds places that occur twice; a file in ascending order needs no sorting.
  void check_places() {
    if (format_.replicates == Replicates::kept) return;
    const std::vector<Observation>& rows = result_.rows;
    const auto is_descent = [&](const Observation& a, const Observation& b) {
      return !(place_of(a) < place_of(b));
    };
    if (std::adjacent_find(rows.begin(), rows.end(), is_descent) == rows.end()) return;
    std::vector<std::size_t> order(rows.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      if (place_of(rows[a]) == place_of(rows[b])) return a < b;
      return place_of(rows[a]) < place_of(rows[b]);
    });
    if (format_.replicates == Replicates::averaged) return average(order);
    bool is_first = true;
    for (std::size_t i = 1, first = 0; i < order.size(); ++i) {
      if (place_of(rows[order[i]]) != place_of(rows[order[first]])) {
        first = i;
        continue;
      }
      const Origin& again = origins_[order[i]];
      const bool has_place = columns_->has(Column::z);
      const Observation& row = rows[order[i]];
      report_.add(
          position_of(again, has_place ? Column::z : Column::t),
          {fmt::format("{}[{}]", has_place ? "z" : "t", again.row), number_text(has_place ? row.z : row.t),
           fmt::format("must differ from {} of line {}{}", has_place ? "z" : "t",
                       source_.position(origins_[order[first]].offset).line,
                       !has_place                     ? ""
                       : columns_->has(Column::width) ? ", which has the same t and width"
                                                      : ", which has the same t") +
               (std::exchange(is_first, false)
                    ? "; or be kept or averaged by replicates = \"keep\" or \"mean\""
                    : "")});
    }
  }

  /// The means of the values at one place, where the first of them stood. Their spread, pooled over all places, is that
  /// of one value: at one place there are too few to tell.
  void average(const std::vector<std::size_t>& order) {
    std::vector<Observation>& rows = result_.rows;
    std::vector<std::size_t> counts(rows.size(), 0);  // of the values a kept row stands for
    double spread = 0;  // the root of a sum of squares, of numbers as large as doubles are
    std::size_t n_free = 0;
    for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
      for (end = first; end < order.size() && place_of(rows[order[end]]) == place_of(rows[order[first]]);)
        ++end;
      const auto n = static_cast<double>(end - first);
      const double one = rows[order[first]].value;
      double mean = one;  // to the bit, where all are the same
      for (std::size_t i = first; i < end; ++i) mean += rows[order[i]].value / n - one / n;
      for (std::size_t i = first; i < end; ++i) spread = std::hypot(spread, rows[order[i]].value - mean);
      n_free += end - first - 1;
      rows[order[first]].value = mean;
      counts[order[first]] = end - first;
    }
    if (n_free > 0) spread /= std::sqrt(static_cast<double>(n_free));
    if (!std::isfinite(spread)) {
      const Observation& row = rows[order[0]];
      report_.add(position_of(origins_[order[0]], columns_->value()),
                  {std::string(name_of(columns_->value())), number_text(row.value),
                   "must be among values that differ by less than 1e308, to be averaged"});
      return;
    }
    const std::size_t n_values = rows.size();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < n_values; ++i) {
      if (counts[i] == 0) continue;
      rows[kept] = rows[i];
      origins_[kept] = origins_[i];
      if (spread > 0) rows[kept].sigma = spread / std::sqrt(static_cast<double>(counts[i]));
      ++kept;
    }
    rows.resize(kept);
    origins_.resize(kept);
    averaged_ = fmt::format("means of {} values at {} places, which scatter by {}", n_values, kept,
                            number_text(spread, 3));
  }

  void say_what_was_understood() {
    std::vector<std::string> parts;
    if (!source_.encoding().empty()) parts.push_back(std::string(source_.encoding()) + " text");
    if (const std::string dialect = dialect_.text(); !dialect.empty()) parts.push_back(dialect);
    if (n_preamble_ > 0)
      parts.push_back(fmt::format("{} line{} before the header", n_preamble_, n_preamble_ == 1 ? "" : "s"));
    if (dialect_.units) parts.emplace_back("a row of units");
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
    const bool is_sum = result_.quantity == Quantity::cumulative;
    StateRange<double> possible = *phi_;
    if (result_.quantity == Quantity::bed_height) possible = {0, 1};
    const double height = result_.quantity == Quantity::bed_height || is_sum ? top_ - bottom_ : 1;
    const double width = height * (possible.highest - possible.lowest);
    const double lowest =
        height * std::min(possible.lowest, is_sum ? 0.0 : possible.lowest) - kImpossible * width;
    const double highest = height * possible.highest + kImpossible * width;
    for (std::size_t i = 0; i < result_.rows.size(); ++i) {
      const double value = result_.rows[i].value;
      if (value >= lowest && value <= highest) continue;
      const Column column = columns_->value();
      report_.add(
          position_of(origins_[i], column),
          {fmt::format("{}[{}]", name_of(column), origins_[i].row), number_text(value),
           fmt::format("must lie near what the scene allows, {} to {}",
                       number_text(height * possible.lowest, 6), number_text(height * possible.highest, 6))});
    }
    if (!is_sum && result_.quantity != Quantity::bed_height && target_.are_parts && report_.is_empty())
      refuse_percent();
  }

  void refuse_percent() {
    for (std::size_t i = 0; i < result_.rows.size(); ++i) {
      const double value = result_.rows[i].value;
      if (std::abs(value) <= kPlausiblePhi) continue;
      report_.add(position_of(origins_[i], columns_->value()),
                  {fmt::format("{}[{}]", name_of(columns_->value()), origins_[i].row), number_text(value),
                   "must be a fraction of 1; what is in percent must say so: phi [%] in the header"});
      return;  // the others are as wrong
    }
  }

  void note_range() {
    if (result_.quantity == Quantity::cumulative) return;
    if (result_.quantity == Quantity::bed_height) return note_heights();
    if (phi_ && !(phi_->lowest == 0 && phi_->highest <= 1)) return note_states();
    const auto largest =
        std::max_element(result_.rows.begin(), result_.rows.end(),
                         [](const Observation& a, const Observation& b) { return a.value < b.value; });
    if (largest->value > kPlausiblePhi)
      result_.notes.push_back(
          fmt::format("{}: phi goes up to {}; {} (is it in percent?)", printable(source_.name()),
                      number_text(largest->value),
                      phi_ ? "it must be a fraction, 1 where all grains are small"
                           : "it must be a fraction unless the flux of its scene has other states"));
  }

  void note_states() {
    const double width = phi_->highest - phi_->lowest;
    for (const Observation& o : result_.rows) {
      if (o.value <= phi_->highest + width && o.value >= phi_->lowest - width) continue;
      result_.notes.push_back(
          fmt::format("{}: phi = {} where the flux has states from {} to {} (in another unit?)",
                      printable(source_.name()), number_text(o.value), number_text(phi_->lowest, 6),
                      number_text(phi_->highest, 6)));
      return;
    }
  }

  /// A bed whose grains have come apart is as high as the domain, one that mixes hardly lower.
  void note_heights() {
    constexpr double kPlausible = 2;
    const double height = top_ - bottom_;
    if (!std::isfinite(height)) return;
    for (const Observation& o : result_.rows) {
      if (o.value < kPlausible * height && o.value > height / kPlausible) continue;
      result_.notes.push_back(
          fmt::format("{}: H = {} where a segregated bed has {}, the height of the domain (in another unit?)",
                      printable(source_.name()), number_text(o.value), number_text(height)));
      return;
    }
  }

  static constexpr std::size_t kLongestShown = 40;

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
  return ObservationsReader(TextSource::read_decoded(path), bottom, top, format).read();
}

Observations read_observations(const std::string& path, const Scene<double>& scene,
                               const ObservationFormat& format) {
  return ObservationsReader(TextSource::read_decoded(path), scene, format).read();
}

Observations parse_observations(std::string text, const std::string& file, double bottom, double top,
                                const ObservationFormat& format) {
  return ObservationsReader(TextSource::decode(file, std::move(text)), bottom, top, format).read();
}

Observations parse_observations(std::string text, const std::string& file, const Scene<double>& scene,
                                const ObservationFormat& format) {
  return ObservationsReader(TextSource::decode(file, std::move(text)), scene, format).read();
}

}  // namespace shearfront
