// SPDX-License-Identifier: BSD-3-Clause
#include "compare/report.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "cli/table.hpp"
#include "shearfront/io/detail/json.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::tools {
namespace {

using detail::Json;

constexpr std::array<double, 4> kErrors{1e-3, 1e-4, 1e-6, 1e-10};
constexpr std::size_t kMostEvents = 11;  // four interfaces

std::string time_text(const TimeToError& time) {
  switch (time.kind) {
    case TimeToError::Kind::within_first:
      return "< " + duration_text(time.wall_s);
    case TimeToError::Kind::interpolated:
      return duration_text(time.wall_s);
    case TimeToError::Kind::extrapolated:
      return "~" + duration_text(time.wall_s) + " (extrapolated)";
    default:
      return "cannot";
  }
}

std::string_view kind_name(TimeToError::Kind kind) {
  switch (kind) {
    case TimeToError::Kind::within_first:
      return "within the first rung";
    case TimeToError::Kind::interpolated:
      return "interpolated";
    case TimeToError::Kind::extrapolated:
      return "extrapolated";
    default:
      return "cannot";
  }
}

std::string per_unit(const Rung& rung) {
  return rung.work > 0 ? fmt::format("{:.3g} ns", 1e9 * rung.wall_s / static_cast<double>(rung.work)) : "";
}

std::string rungs_text(const Panel& panel) {
  TextTable table({"method", "resolution", "L1 error", "order", "work", "per unit", "time"});
  for (const Course& course : panel.courses)
    for (std::size_t i = 0; i < course.rungs.size(); ++i) {
      const Rung& rung = course.rungs[i];
      const auto order = course.order(i);
      table.add({course.contestant.name, number_text(rung.resolution), fmt::format("{:.2e}", rung.l1_error),
                 order ? fmt::format("{:.2f}", *order) : "", std::to_string(rung.work), per_unit(rung),
                 fmt::format("{:.3g} s", rung.wall_s)});
    }
  return table.text();
}

std::string errors_text(const Panel& panel) {
  std::vector<std::string> headings{"time to an L1 error of"};
  for (const double error : kErrors) headings.push_back(number_text(error));
  TextTable table(headings);
  for (const Course& course : panel.courses) {
    if (course.rungs.empty()) continue;
    std::vector<std::string> row{course.contestant.name};
    for (const double error : kErrors) row.push_back(time_text(time_to_error(course, error)));
    table.add(row);
  }
  return table.text();
}

Json course_json(const Course& course) {
  Json rungs = Json::array(), times = Json::array();
  for (std::size_t i = 0; i < course.rungs.size(); ++i) {
    const Rung& r = course.rungs[i];
    rungs.push_back({{"resolution", r.resolution},
                     {"l1_error", r.l1_error},
                     {"order", detail::json_or_null(course.order(i))},
                     {"wall_s", r.wall_s},
                     {"work", r.work}});
  }
  for (const double error : kErrors) {
    const TimeToError time = time_to_error(course, error);
    const bool is_known = time.kind != TimeToError::Kind::never;
    times.push_back({{"l1_error", error},
                     {"wall_s", is_known ? Json(time.wall_s) : Json()},
                     {"how", kind_name(time.kind)}});
  }
  return {{"method", course.contestant.name}, {"ended", course.ended}, {"rungs", rungs}, {"time_to_error", times}};
}

Json events_json(const ObservedEvents& events) {
  Json rows = Json::array();
  for (const ObservedEvents::Row& row : events.rows) {
    Json times = Json::array();
    for (std::size_t i = 0; i < events.names.size(); ++i)
      times.push_back({{"event", events.names[i]},
                       {"exact", detail::json_or_null(events.exact[i])},
                       {"observed", detail::json_or_null(row.times[i])}});
    rows.push_back({{"method", row.method}, {"resolution", row.resolution}, {"times", times}});
  }
  return rows;
}

}  // namespace

std::string duration_text(double seconds) {
  constexpr double kMinute = 60, kHour = 3600, kDay = 24 * kHour, kYear = 365.25 * kDay;
  if (seconds < 2 * kMinute) return fmt::format("{:.2g} s", seconds);
  if (seconds < 2 * kHour) return fmt::format("{:.2g} min", seconds / kMinute);
  if (seconds < 2 * kDay) return fmt::format("{:.2g} h", seconds / kHour);
  if (seconds < kYear) return fmt::format("{:.0f} days", seconds / kDay);
  return fmt::format("{:.0f} years", seconds / kYear);
}

std::string race_text(const std::vector<Panel>& panels) {
  std::string all;
  for (const Panel& panel : panels)
    all += fmt::format("\nt = {}\n\n{}\n{}", number_text(panel.t), rungs_text(panel), errors_text(panel));
  return all;
}

std::string race_csv(const std::vector<Panel>& panels) {
  std::string rows = "method,resolution,t,l1_error,wall_s,work\n";
  for (const Panel& panel : panels)
    for (const Course& course : panel.courses)
      for (const Rung& r : course.rungs)
        rows += fmt::format("{},{},{},{},{},{}\n", course.contestant.name, number_text(r.resolution),
                            number_text(panel.t), number_text(r.l1_error), number_text(r.wall_s), r.work);
  return rows;
}

std::string events_text(const ObservedEvents& events) {
  // Of many interfaces only the other events fit into a line; JSON has them all.
  const bool has_all = events.names.size() <= kMostEvents;
  const auto is_shown = [&](std::size_t i) {
    return has_all || events.names[i].find('(') == std::string::npos;
  };
  std::vector<std::string> headings{"relative error of", "resolution"}, exact{"exact time", ""};
  for (std::size_t i = 0; i < events.names.size(); ++i) {
    if (!is_shown(i)) continue;
    headings.push_back(events.names[i]);
    exact.push_back(events.exact[i] ? fmt::format("{:.6g}", *events.exact[i]) : "never");
  }
  TextTable table(headings);
  table.add(exact);
  for (const ObservedEvents::Row& row : events.rows) {
    std::vector<std::string> cells{row.method, number_text(row.resolution)};
    for (std::size_t i = 0; i < row.times.size(); ++i) {
      if (!is_shown(i)) continue;
      const auto &time = row.times[i], &truth = events.exact[i];
      if (!time || !truth)
        cells.push_back(!time && !truth ? "agrees" : time ? fmt::format("at {:.3g}", *time) : "not seen");
      else
        cells.push_back(*truth > 0 ? fmt::format("{:.1e}", *time / *truth - 1)
                                   : fmt::format("{:.1e} late", *time));
    }
    table.add(cells);
  }
  return "\n" + table.text();
}

std::string race_json(std::string_view scene, const std::vector<Panel>& panels,
                      const ObservedEvents* events) {
  Json times = Json::array();
  for (const Panel& panel : panels) {
    Json courses = Json::array();
    for (const Course& course : panel.courses) courses.push_back(course_json(course));
    times.push_back({{"t", panel.t}, {"methods", courses}});
  }
  return detail::json_document({{"scene", scene}, {"times", times}, {"events", events ? events_json(*events) : Json()}});
}

}  // namespace shearfront::tools
