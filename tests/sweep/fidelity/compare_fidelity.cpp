#include "sweep/fidelity/compare_fidelity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace voxtet::sweep {
namespace {

using nlohmann::json;

constexpr double kMeanDistance = 0.05;  ///< of the mean before
constexpr double kLargestVoxels = 0.5;
constexpr double kDice = 0.002;
constexpr double kVolumePercent = 0.2;

constexpr std::array kDistances{"to_smoothed", "from_smoothed", "to_voxels", "from_voxels"};

std::string number(double value, int decimals) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

double least_of(const json& by_label) {
  double least = 1;
  for (const json& value : by_label) least = std::min(least, value.get<double>());
  return least;
}

double mean_of(const json& by_label) {
  double sum = 0;
  for (const json& value : by_label) sum += value.get<double>();
  return sum / static_cast<double>(by_label.size());
}

double largest_of(const json& by_label) {
  double largest = 0;
  for (const json& value : by_label) largest = std::max(largest, std::abs(value.get<double>()));
  return largest;
}

/// A column that needs one row alone.
struct Column {
  const char* heading;
  std::string (*text)(const json& row);
};

std::string distance_text(const json& distance) {
  return number(distance["mean"], 4) + "/" + number(distance["max"], 2);
}

std::string seconds_text(const json& row) {
  double sum = 0;
  std::string text;
  for (const char* stage : {"volume", "surface", "smooth", "sizing", "remesh", "tetra", "optimise"}) {
    const double seconds = row["seconds"][stage];
    sum += seconds;
    text += (text.empty() ? "" : "/") + number(seconds, 2);
  }
  return number(sum, 1) + " = " + text;
}

const std::array kColumns{
    Column{"tets", [](const json& row) { return row["tets"].dump(); }},
    Column{"facets", [](const json& row) { return row["triangles"].dump(); }},
    Column{"dihedral: least/0.1 %",
           [](const json& row) {
             return number(row["dihedral_deg"]["least"], 1) + "/" + number(row["dihedral_deg"]["p01"], 1);
           }},
    Column{"to smoothed: mean/max", [](const json& row) { return distance_text(row["to_smoothed"]); }},
    Column{"from smoothed", [](const json& row) { return distance_text(row["from_smoothed"]); }},
    Column{"to voxels", [](const json& row) { return distance_text(row["to_voxels"]); }},
    Column{"from voxels", [](const json& row) { return distance_text(row["from_voxels"]); }},
    Column{"Dice: least/mean",
           [](const json& row) {
             return number(least_of(row["dice"]), 4) + "/" + number(mean_of(row["dice"]), 4);
           }},
    Column{"volume: largest error, %",
           [](const json& row) { return number(largest_of(row["volume_percent"]), 2); }},
    Column{"ledger differences", [](const json& row) { return std::to_string(row["ledger"].size()); }},
    Column{"sphere: radius rms, normals (degrees)",
           [](const json& row) {
             if (!row.contains("truth")) return std::string("-");
             const json& mesh = row["truth"]["mesh"];
             return number(mesh["radial_voxels"], 3) + ", " + number(mesh["normal_deg"], 2);
           }},
    Column{"processor s: volume/surface/smooth/sizing/remesh/tetra/optimise", seconds_text},
};

/// `loss`: by how much a label's figure became worse from before to now.
void compare_labels(const json& before, const json& now, const char* what, double most,
                    double (*loss)(double before, double now), std::vector<std::string>& worse) {
  for (const auto& [label, value] : before.items()) {
    if (!now.contains(label)) {
      worse.push_back("label " + label + " is no longer there");
      continue;
    }
    const double then = value, after = now[label];
    if (!(loss(then, after) <= most))
      worse.push_back(std::string(what) + " of label " + label + " " + number(then, 4) + " -> " +
                      number(after, 4) + ", may change by " + number(most, 3));
  }
}

}  // namespace

void print_fidelity_heading() {
  std::printf("| case |");
  for (const Column& column : kColumns) std::printf(" %s |", column.heading);
  std::printf("\n|---|");
  for (std::size_t c = 0; c < kColumns.size(); ++c) std::printf("---|");
  std::printf("\n");
}

void print_fidelity(const std::string& name, const json* before, const json& now) {
  std::printf("| %s |", name.c_str());
  for (const Column& column : kColumns) {
    const std::string then = before ? column.text(*before) : "", text = column.text(now);
    std::printf(" %s%s |", before && then != text ? (then + " -> ").c_str() : "", text.c_str());
  }
  std::printf("\n");
  std::fflush(stdout);
}

std::vector<std::string> what_became_worse(const json& before, const json& now) {
  std::vector<std::string> worse;
  if (before["reference"] != now["reference"])
    worse.push_back("measured against another reference than before; expected --references of that run");
  for (const char* what : kDistances) {
    const double mean = now[what]["mean"], mean_before = before[what]["mean"];
    if (!(mean <= (1 + kMeanDistance) * mean_before))
      worse.push_back(std::string("mean distance ") + what + " " + number(mean_before, 4) + " -> " +
                      number(mean, 4) + ", may grow by 5 %");
    const double largest = now[what]["max"], largest_before = before[what]["max"];
    if (!(largest <= largest_before + kLargestVoxels))
      worse.push_back(std::string("largest distance ") + what + " " + number(largest_before, 2) + " -> " +
                      number(largest, 2) + ", may grow by half a voxel");
  }
  compare_labels(
      before["dice"], now["dice"], "Dice", kDice, [](double then, double after) { return then - after; },
      worse);
  compare_labels(
      before["volume_percent"], now["volume_percent"], "volume error (%)", kVolumePercent,
      [](double then, double after) { return std::abs(after) - std::abs(then); }, worse);
  if (before["ledger"] != now["ledger"])
    worse.push_back("topology ledger " + before["ledger"].dump() + " -> " + now["ledger"].dump());
  return worse;
}

}  // namespace voxtet::sweep
