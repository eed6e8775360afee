// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/profile.hpp"
#include "shearfront/solution/summary.hpp"
#include "shearfront/solution/timeline.hpp"
#include "shearfront/solver/option.hpp"
#include "shearfront/solver/solver.hpp"

namespace shearfront {

enum class GridKind { levels, singular_mapping };
enum class Reconstruction { constant, linear };
/// First arrivals of fans: of the characteristic at their edge, or of the first front, as the polygon has it.
enum class FanEdges { characteristic, secant };
/// Their names in files and on the command line, in the order of the enumerators.
inline constexpr std::array<std::string_view, 2> kGridNames{"levels", "singular-mapping"};
inline constexpr std::array<std::string_view, 2> kReconstructionNames{"constant", "linear"};
inline constexpr std::array<std::string_view, 2> kFanEdgeNames{"characteristic", "secant"};

/// How a scene is tracked, and what is kept of it.
struct TrackOptions {
  double resolution = 0.01;
  GridKind grid = GridKind::levels;
  Reconstruction reconstruct = Reconstruction::constant;
  FanEdges edges = FanEdges::characteristic;
  std::uint64_t max_collisions = 4'000'000'000;
  std::uint64_t max_fronts =
      50'000'000;        ///< alive at one time; 3 GB, and as much again while their list grows
  bool fronts = false;   ///< keep all fronts
  bool history = false;  ///< keep all fronts and collisions

  /// What the command line and files can set.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(
        OptionInfo{
            "resolution", "largest step of phi in a fan, or delta of the singular mapping", {0, 1, true}},
        self.resolution);
    visit(OptionInfo{"grid", "grid of states", {}, kGridNames}, self.grid);
    visit(OptionInfo{"reconstruct", "phi between fronts", {}, kReconstructionNames}, self.reconstruct);
    visit(OptionInfo{"edges", "first arrivals of fans", {}, kFanEdgeNames, {}, true}, self.edges);
    visit(OptionInfo{"max-collisions", "stop after so many collisions", {1, 1e15}, {}, {}, true},
          self.max_collisions);
    visit(
        OptionInfo{"max-fronts", "stop with so many fronts alive, of 64 bytes each", {1, 2e9}, {}, {}, true},
        self.max_fronts);
  }
};

/// Fronts that met in one point, and the fronts that left it.
struct Collision {
  double t, z;
  std::optional<std::size_t> boundary;  ///< where they met: 0 the bottom, then the interfaces, then the top;
                                        ///< none inside a layer
  std::size_t incoming, outgoing;       ///< how many
};

namespace track_detail {
class AnyTracking;
}

/// A bed under way from t = 0, followed by front tracking: exact for a flux made a polygon. Grid of states
/// and ends are those the scene asks for.
///
/// A value: copy it to keep a state to return to. Guarantees and cost: track/tracker.hpp in the sources.
class Tracking {
 public:
  /// Errors: InputError (key "method") with refusal().
  explicit Tracking(const Scene<double>& scene, const TrackOptions& options = {}, Progress progress = {});
  Tracking(const Tracking& other);
  Tracking(Tracking&&) noexcept;
  Tracking& operator=(Tracking other) noexcept;
  ~Tracking();

  /// Why the scene cannot be tracked with these options; empty if it can.
  [[nodiscard]] static std::string refusal(const Scene<double>& scene, const TrackOptions& options = {});

  /// Runs to time t, collisions at t included; +infinity runs to the steady state, which a periodic bed does
  /// not have. Precondition: t >= time(). Status::ok, or steady if nothing will ever happen again. After any
  /// other status only summary() may be asked.
  Status advance(double t);
  [[nodiscard]] double time() const;
  /// phi at time(), between walls, interfaces and fronts: constant, or linear where fronts are the states of
  /// a fan (TrackOptions::reconstruct).
  [[nodiscard]] Profile<double> profile() const;
  /// The same at any height: phi and M, and integrals. `scene` is that it was made with, and must outlive the field.
  [[nodiscard]] std::unique_ptr<Field> field(const Scene<double>& scene) const;
  /// All fronts up to time(), by the time and height at which they begin; those alive end at time().
  /// Precondition: they are kept (TrackOptions::fronts or history).
  [[nodiscard]] std::vector<FrontSegment<double>> fronts() const;
  /// All collisions up to time(), by time and height. Precondition: they are kept (TrackOptions::history).
  [[nodiscard]] std::vector<Collision> collisions() const;
  /// Event times: runs to the steady state. None for a bed without walls at both ends, and if the run stopped
  /// before.
  [[nodiscard]] std::optional<Timeline<double>> timeline();
  /// How it went so far.
  [[nodiscard]] Summary summary() const;

 private:
  std::unique_ptr<track_detail::AnyTracking> tracking_;
};

/// A scene under way by front tracking:
///
///     Tracking bed = track(scene, {.resolution = 0.01, .history = true});
///     bed.advance(2.5);
///     const Profile<double> phi = bed.profile();
[[nodiscard]] inline Tracking track(const Scene<double>& scene, const TrackOptions& options = {}) {
  return Tracking(scene, options);
}

}  // namespace shearfront
