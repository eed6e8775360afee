// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/observation_rows.hpp"

#include <fmt/format.h>

#include <utility>

#include "shearfront/io/detail/cell_text.hpp"
#include "shearfront/io/detail/table_lines.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::detail {

ObservationRows::ObservationRows(const TextSource& source, double bottom, double top,
                                 const ObservationFormat& format)
    : source_(source),
      dialect_(dialect_of(source, format)),
      format_(format_of(dialect_.code, format)),
      simulation_(dialect_.code),
      report_(source.name(), kMostComplaints),
      bottom_(bottom),
      top_(top) {}

std::optional<std::size_t> ObservationRows::take_apart(std::size_t offset, std::string_view line,
                                                       std::vector<CsvField>& fields) const {
  const auto bad_quotes = split_csv(line, fields, dialect_.separator);
  simulation_.complete(fields, offset == dialect_.header);
  return bad_quotes;
}

void ObservationRows::read_row(std::size_t offset) {
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

bool ObservationRows::read_time(std::size_t offset, Observation& o) {
  if (!read_number(offset, Column::t, o.t)) return false;
  if (dialect_.code == SimulationCode::lammps) o.t *= format_.time_step.value_or(1);
  return o.t >= 0 || refuse(offset, Column::t, "must be >= 0");
}

void ObservationRows::read_value(std::size_t offset, std::size_t field, Observation o, bool is_good) {
  const Column column = columns_->value();
  const bool has_value = !is_missing(fields_[field].text, format_.missing);
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

bool ObservationRows::read_place(std::size_t offset, Observation& o) {
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

bool ObservationRows::set_width(std::size_t offset, Observation& o) {
  o.width = width_;
  if (width_ == 0 || (is_bin_resolved(o.z, width_) && is_bin_inside(o.z, width_, bottom_, top_))) return true;
  add(offset, "z", number_text(o.z),
      fmt::format("must leave its bin of width {} inside the domain {}", number_text(width_), domain()));
  return false;
}

bool ObservationRows::read_sigma(std::size_t offset, Observation& o) {
  if (!columns_->has(Column::sigma) ||
      is_missing(fields_[columns_->field(Column::sigma)].text, format_.missing))
    return true;
  if (!read_number(offset, Column::sigma, o.sigma)) return false;
  return o.sigma > 0 || refuse(offset, Column::sigma, "must be > 0");
}

bool ObservationRows::read_number(std::size_t offset, Column column, double& x) {
  return read_number(offset, column, columns_->field(column), x, "");
}

bool ObservationRows::read_number(std::size_t offset, Column column, std::size_t field, double& x,
                                  std::string_view alternative) {
  const std::string_view text = fields_[field].text;
  if (const auto number = number_with_mark(text, dialect_.decimal)) {
    x = *number * columns_->factor(column);
    return true;
  }
  return refuse(offset, column, field, why_no_number(text, dialect_.decimal) + std::string(alternative));
}

bool ObservationRows::refuse(std::size_t offset, Column column, std::string constraint) {
  return refuse(offset, column, columns_->field(column), std::move(constraint));
}

bool ObservationRows::refuse(std::size_t offset, Column column, std::size_t at, std::string constraint) {
  const CsvField& field = fields_[at];
  add(offset + field.offset, std::string(name_of(column)), shown_number(field.text), std::move(constraint));
  return false;
}

bool ObservationRows::refuse_place(std::size_t field, Column column, double place, std::string constraint) {
  report_.add(position_in(dialect_.header, field),
              {std::string(name_of(column)), number_text(place), std::move(constraint)});
  return false;
}

void ObservationRows::add(std::size_t offset, const std::string& key, std::string value,
                          std::string constraint) {
  report_.add(source_.position(offset),
              {fmt::format("{}[{}]", key, n_rows_), std::move(value), std::move(constraint)});
}

std::string ObservationRows::domain() const {
  return fmt::format("[{}, {}]", number_text(bottom_), number_text(top_));
}

Position ObservationRows::position_of(const Origin& origin, Column column) {
  const bool is_of_row = columns_->has(column) && column != columns_->value();
  return position_in(origin.offset, is_of_row ? columns_->field(column) : origin.field);
}

Position ObservationRows::position_in(std::size_t line, std::size_t field) const {
  std::vector<CsvField> fields;
  (void)take_apart(line, line_at(source_.text(), line), fields);
  return source_.position(line + fields[field].offset);
}

}  // namespace shearfront::detail
