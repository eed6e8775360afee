// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/observations_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "shearfront/io/detail/observation_columns.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/scene/state_range.hpp"

namespace shearfront {
namespace {

using detail::Column;
using detail::ComplaintReport;
using detail::CsvField;
using detail::ObservationColumns;
using detail::Position;
using detail::TextSource;

constexpr double kPlausiblePhi = 2;  // beyond it phi is no fraction with noise, but probably in percent
/// A value this many times farther off than any that is possible is no measurement with noise.
constexpr double kImpossible = 1000;

bool is_missing(std::string_view text) { return text.empty() || text == "NA"; }

/// Why parse_number() refuses the text.
std::string_view why_no_number(std::string_view text) {
  if (!text.empty() && text[0] == '+') text.remove_prefix(1);
  double x = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (text.empty() || end != text.data() + text.size()) return "must be a number";
  return error == std::errc::result_out_of_range
             ? "must be 0 or between 5e-324 and 1.7976931348623157e308 in size"
             : "must be a finite number";
}

auto place_of(const Observation& o) { return std::tie(o.t, o.z, o.width); }

class ObservationsReader {
 public:
  ObservationsReader(const TextSource& source, double bottom, double top)
      : source_(source), report_(source.name(), kMostComplaints), bottom_(bottom), top_(top) {}
  ObservationsReader(const TextSource& source, const Scene<double>& scene)
      : ObservationsReader(source, scene.bottom(), scene.top()) {
    phi_ = phi_range(scene);
  }

  Observations read() {
    const std::string_view text = source_.text();
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      read_line(begin, text.substr(begin, end - begin));
      begin = end + 1;
    }
    if (!columns_) {
      report_.add({1, 1}, {"header", "", "missing; must name the columns, such as t,z,phi"});
    } else if (n_rows_ == 0) {
      report_.add({1, 1}, {"rows", "", "missing; must follow the header"});
    } else if (result_.n_missing == n_rows_) {
      report_.add(columns_->position(columns_->value()),
                  {std::string(name_of(columns_->value())), "",
                   fmt::format("missing in every row ({}); must be there in one at least", n_rows_)});
    }
    check_sigma();
    check_places();
    check_sizes();
    report_.throw_if_any();
    note_range();
    return std::move(result_);
  }

 private:
  /// A row of the result: where it came from.
  struct Origin {
    std::size_t row, offset;
  };

  void read_line(std::size_t offset, std::string_view line) {
    const std::string_view content = detail::trimmed(line);
    if (content.empty()) return;
    if (content[0] == '#') {
      result_.comments.emplace_back(content.substr(content.starts_with("# ") ? 2 : 1));
      return;
    }
    const auto bad_quotes = detail::split_csv(line, fields_);
    if (bad_quotes)
      report_.add(source_.position(offset + *bad_quotes),
                  {columns_ ? fmt::format("row[{}]", n_rows_) : "header", "",
                   "must close its quotes on the same line, before a comma"});
    if (columns_) {
      if (!bad_quotes) read_row(offset);
      ++n_rows_;
      return;
    }
    if (!bad_quotes) columns_.emplace(source_, offset, fields_, report_);
    report_.throw_if_any();  // without a header nothing is known about the rows
    result_.quantity = columns_->quantity();
    result_.units = columns_->units();
    result_.notes = columns_->notes();
  }

  void read_row(std::size_t offset) {
    if (fields_.size() != columns_->n_fields()) {
      add(offset, "row", fmt::format("({} field{})", fields_.size(), fields_.size() == 1 ? "" : "s"),
          fmt::format("must have {} ({})", columns_->n_fields(), columns_->names()));
      return;
    }
    Observation o;
    bool is_good = read_number(offset, Column::t, o.t, "");
    if (is_good && !(o.t >= 0)) is_good = refuse(offset, Column::t, "must be >= 0");
    if (columns_->has(Column::z)) is_good = read_place(offset, o) && is_good;
    const bool has_value = !is_missing(fields_[columns_->field(columns_->value())].text);
    if (has_value)
      is_good =
          read_number(offset, columns_->value(), o.value, ", or empty or NA if it is missing") && is_good;
    if (has_value && is_good && columns_->has(Column::H) && !(o.value > 0))
      is_good = refuse(offset, Column::H, "must be > 0");
    is_good = read_sigma(offset, o) && is_good;
    if (!has_value) {
      ++result_.n_missing;
    } else if (is_good) {
      result_.rows.push_back(o);
      origins_.push_back({n_rows_, offset});
    }
  }

  bool read_place(std::size_t offset, Observation& o) {
    bool is_good = read_number(offset, Column::z, o.z, "");
    if (is_good && !(o.z >= bottom_ && o.z <= top_))
      is_good = refuse(offset, Column::z, "must be inside the domain " + domain());
    if (!columns_->has(Column::width)) return is_good;
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

  bool read_sigma(std::size_t offset, Observation& o) {
    if (!columns_->has(Column::sigma) || is_missing(fields_[columns_->field(Column::sigma)].text))
      return true;
    if (!read_number(offset, Column::sigma, o.sigma, "")) return false;
    return o.sigma > 0 || refuse(offset, Column::sigma, "must be > 0");
  }

  bool read_number(std::size_t offset, Column column, double& x, std::string_view alternative) {
    const std::string_view text = fields_[columns_->field(column)].text;
    if (const auto number = parse_number(text)) {
      x = *number;
      return true;
    }
    return refuse(offset, column,
                  std::string(text.empty() ? "missing; " : "") + std::string(why_no_number(text)) +
                      std::string(alternative));
  }

  /// Notes what is wrong with a field of the row that is being read; false for convenience.
  bool refuse(std::size_t offset, Column column, std::string constraint) {
    const CsvField& field = fields_[columns_->field(column)];
    add(offset + field.offset, std::string(name_of(column)), shown(field.text), std::move(constraint));
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

  /// Where a field of a row of the result stands.
  [[nodiscard]] Position position_of(const Origin& origin, Column column) {
    const std::string_view text = source_.text();
    const std::size_t end = std::min(text.find('\n', origin.offset), text.size());
    (void)detail::split_csv(text.substr(origin.offset, end - origin.offset), fields_);
    return source_.position(origin.offset + fields_[columns_->field(column)].offset);
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
                                                      : ", which has the same t")});
    }
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
  ComplaintReport report_;
  double bottom_, top_;
  std::optional<StateRange<double>> phi_;  ///< that the scene allows, if there is one
  std::optional<ObservationColumns> columns_;
  std::vector<CsvField> fields_;  ///< of the line that is being read
  std::size_t n_rows_ = 0;        ///< read so far; the number of the row that is being read
  Observations result_;
  std::vector<Origin> origins_;  ///< of result_.rows
};

}  // namespace

Observations read_observations(const std::string& path, double bottom, double top) {
  return ObservationsReader(TextSource::read(path), bottom, top).read();
}

Observations read_observations(const std::string& path, const Scene<double>& scene) {
  return ObservationsReader(TextSource::read(path), scene).read();
}

Observations parse_observations(std::string text, const std::string& file, double bottom, double top) {
  return ObservationsReader(TextSource(file, std::move(text)), bottom, top).read();
}

}  // namespace shearfront
