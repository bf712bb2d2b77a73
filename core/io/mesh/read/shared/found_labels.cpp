#include "io/mesh/read/shared/found_labels.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <unordered_map>

#include "io/bytes/header_text.h"

namespace voxtet {
namespace {

constexpr std::int64_t kMostLabel = std::numeric_limits<Label>::max();
constexpr std::size_t kMostShown = 3;

bool is_label(std::int64_t value) {
  return value >= 1 && value <= kMostLabel;
}

/// "LV_myocardium_1" is of label 1.
std::optional<std::int64_t> number_at_end(const std::string& name) {
  const std::size_t at = name.rfind('_');
  if (at == std::string::npos) return std::nullopt;
  const auto number = parse_integer(std::string_view(name).substr(at + 1));
  return number && is_label(*number) ? number : std::nullopt;
}

}  // namespace

void add_note(MeshArrays* arrays, const std::string& note) {
  if (arrays) arrays->notes.push_back(note);
}

void set_labels(MeshCursor& in, TetMesh& mesh, const std::vector<std::int64_t>& values,
                const std::string& what, MeshArrays* arrays) {
  if (!in.ok()) return;
  std::vector<std::int64_t> distinct;
  for (const std::int64_t value : values)
    if (distinct.empty() || distinct.back() != value) distinct.push_back(value);
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  if (distinct.size() > static_cast<std::size_t>(kMostLabel))
    return in.fail(std::to_string(distinct.size()) + " different values of " + what +
                   ", expected at most 65535 labels");
  std::unordered_map<std::int64_t, std::int64_t> becomes;
  std::string changes;
  std::int64_t free = 0;
  for (const std::int64_t value : distinct) {
    if (is_label(value)) continue;
    while (std::binary_search(distinct.begin(), distinct.end(), ++free)) {
    }
    becomes[value] = free;
    if (becomes.size() <= kMostShown)
      changes +=
          (changes.empty() ? "" : ", ") + std::to_string(value) + " becomes label " + std::to_string(free);
  }
  if (becomes.size() > kMostShown)
    changes += " and " + std::to_string(becomes.size() - kMostShown) + " more alike";
  if (!becomes.empty()) add_note(arrays, what + " " + changes + " (labels are 1 to 65535)");
  mesh.labels.clear();
  mesh.labels.reserve(values.size());
  for (const std::int64_t value : values)
    mesh.labels.push_back(static_cast<Label>(is_label(value) ? value : becomes[value]));
}

void set_one_region(TetMesh& mesh, const std::string& why, MeshArrays* arrays) {
  mesh.labels.assign(mesh.tets.size(), 1);
  add_note(arrays, why + ": all tetrahedra are one region, label 1");
}

void keep_corners(TetMesh& mesh, std::uint64_t curved, MeshArrays* arrays) {
  if (curved == 0) return;
  constexpr std::uint32_t kUnused = 0xffffffff;
  std::vector<std::uint32_t> place(mesh.points.size(), kUnused);
  for (const Tet& tet : mesh.tets)
    for (const std::uint32_t corner : tet) place[corner] = 0;
  std::uint32_t kept = 0;
  for (std::size_t p = 0; p < place.size(); ++p) {
    if (place[p] == kUnused) continue;
    mesh.points[kept] = mesh.points[p];
    place[p] = kept++;
  }
  const std::size_t dropped = mesh.points.size() - kept;
  mesh.points.resize(kept);
  for (Tet& tet : mesh.tets)
    for (std::uint32_t& corner : tet) corner = place[corner];
  add_note(arrays, std::to_string(curved) + " of " + std::to_string(mesh.tets.size()) +
                       " tetrahedra have points on their edges: their corners are read, " +
                       std::to_string(dropped) + " other points left out");
}

std::vector<LabelInfo> named_labels(const std::vector<std::int64_t>& labels,
                                    const std::vector<std::int64_t>& bytes) {
  std::vector<LabelInfo> infos;
  auto begin = bytes.begin();
  for (const std::int64_t label : labels) {
    const auto end = std::find(begin, bytes.end(), 0);
    if (end == bytes.end()) break;
    std::string name;
    for (auto byte = begin; byte != end; ++byte) name += static_cast<char>(*byte);
    add_label_name(label, name, infos);
    begin = end + 1;
  }
  return infos;
}

std::vector<std::int64_t> labels_of_parts(const std::vector<std::string>& names,
                                          std::vector<LabelInfo>& infos) {
  std::vector<std::int64_t> labels;
  std::set<std::int64_t> distinct;
  for (const std::string& name : names)
    if (const auto number = number_at_end(name); number && distinct.insert(*number).second)
      labels.push_back(*number);
  const bool numbered = labels.size() == names.size();
  if (!numbered) labels.clear();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!numbered) labels.push_back(static_cast<std::int64_t>(i + 1));
    const std::string name = numbered ? names[i].substr(0, names[i].rfind('_')) : names[i];
    if (!numbered || name != "label") add_label_name(labels[i], name, infos);
  }
  return labels;
}

}  // namespace voxtet
