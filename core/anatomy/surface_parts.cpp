#include "anatomy/surface_parts.h"

#include <map>
#include <utility>

#include "base/union_find.h"

namespace voxtet::anatomy {
namespace {

constexpr std::uint32_t kNoPart = 0xffffffffU;

/// For each part that gives the name of the longest border; parts that none is beside are left out.
std::map<std::uint32_t, std::uint8_t> names_to_take(const WallSurface& surface, const SurfaceParts& parts,
                                                    const std::vector<Fate>& fates,
                                                    const std::vector<std::uint8_t>& name) {
  std::map<std::pair<std::uint32_t, std::uint8_t>, double> border_mm;
  for (const Contact& contact : surface.contacts)
    for (const auto& [from, to] : {std::pair(contact.a, contact.b), std::pair(contact.b, contact.a)}) {
      const std::uint32_t taker = parts.of[from], giver = parts.of[to];
      if (fates[taker] == Fate::kGives && fates[giver] == Fate::kStays)
        border_mm[{taker, name[giver]}] += contact.length_mm;
    }
  std::map<std::uint32_t, std::uint8_t> chosen;
  std::map<std::uint32_t, double> longest;
  for (const auto& [key, length] : border_mm)
    if (length > longest[key.first]) longest[key.first] = length, chosen[key.first] = key.second;
  return chosen;
}

}  // namespace

SurfaceParts surface_parts(const WallSurface& surface, const std::vector<std::uint8_t>& names) {
  UnionFind joined(names.size());
  for (const Contact& contact : surface.contacts)
    if (names[contact.a] == names[contact.b]) joined.join(contact.a, contact.b);
  SurfaceParts parts;
  std::vector<std::uint32_t> number(names.size(), kNoPart);
  for (std::uint32_t f = 0; f < names.size(); ++f) {
    std::uint32_t& part = number[joined.find(f)];
    if (part == kNoPart) {
      part = static_cast<std::uint32_t>(parts.name.size());
      parts.name.push_back(names[f]);
      parts.area_mm2.push_back(0);
    }
    parts.of.push_back(part);
    parts.area_mm2[part] += surface.faces[f].area_mm2;
  }
  return parts;
}

std::vector<Fate> largest_stay(const SurfaceParts& parts) {
  std::vector<std::uint32_t> largest(256, kNoPart);
  for (std::uint32_t part = 0; part < parts.name.size(); ++part) {
    std::uint32_t& best = largest[parts.name[part]];
    if (best == kNoPart || parts.area_mm2[part] > parts.area_mm2[best]) best = part;
  }
  std::vector<Fate> fates(parts.name.size(), Fate::kGives);
  for (const std::uint32_t part : largest)
    if (part != kNoPart) fates[part] = Fate::kStays;
  return fates;
}

void give_away(const WallSurface& surface, const SurfaceParts& parts, std::vector<Fate> fates,
               std::uint8_t lost, std::vector<std::uint8_t>& names) {
  std::vector<std::uint8_t> name = parts.name;
  while (true) {
    const std::map<std::uint32_t, std::uint8_t> taken = names_to_take(surface, parts, fates, name);
    if (taken.empty()) break;
    for (const auto& [part, new_name] : taken) {
      name[part] = new_name;
      fates[part] = Fate::kStays;
    }
  }
  for (std::size_t part = 0; part < name.size(); ++part)
    if (fates[part] == Fate::kGives) name[part] = lost;
  for (std::size_t f = 0; f < names.size(); ++f) names[f] = name[parts.of[f]];
}

}  // namespace voxtet::anatomy
