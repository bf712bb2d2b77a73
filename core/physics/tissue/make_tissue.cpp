#include "physics/tissue/make_tissue.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "types/stage_names.h"

namespace voxtet {
namespace {

Error tissue_error(const std::string& field, const std::string& found_expected) {
  return usage_error(kTissueStage, "physics.tissue" + field + ": " + found_expected);
}

using KindOfLabel = std::map<Label, std::uint16_t>;

Result<KindOfLabel> kinds_of_labels(const TissueParams& params) {
  if (params.kinds.empty())
    return tissue_error(".kinds",
                        "found no entry, expected at least one: which labels conduct, and how fast");
  KindOfLabel kinds;
  for (std::size_t k = 0; k < params.kinds.size(); ++k) {
    const std::string field = ".kinds[" + std::to_string(k) + "].labels";
    if (params.kinds[k].labels.empty()) return tissue_error(field, "found no label, expected at least one");
    for (const Label label : params.kinds[k].labels)
      if (!kinds.emplace(label, static_cast<std::uint16_t>(k)).second)
        return tissue_error(field, "found " + std::to_string(label) +
                                       ", which has an entry already, expected each "
                                       "label once");
  }
  return kinds;
}

std::uint16_t kind_of(const KindOfLabel& kinds, Label label) {
  const auto found = kinds.find(label);
  return found == kinds.end() ? Tissue::kNone : found->second;
}

/// Changes the tissue of meshed labels by the shares of transferred ones.
void mix(const LabelTransfer& transfer, const KindOfLabel& kinds, Tissue& tissue) {
  tissue.share.assign(tissue.kind.size(), 1);
  for (std::size_t i = 0; i < transfer.labels.size(); ++i) {
    const std::uint16_t kind = kind_of(kinds, transfer.labels[i].label);
    const std::vector<float>& fraction = transfer.fraction(i);
    for (std::size_t t = 0; t < fraction.size(); ++t) {
      if (kind == Tissue::kNone)
        tissue.share[t] -= fraction[t];
      else if (fraction[t] > 0.5F)
        tissue.kind[t] = kind;
    }
  }
  constexpr float kHardlyAny = 1e-3F;
  for (std::size_t t = 0; t < tissue.kind.size(); ++t)
    if (tissue.share[t] < kHardlyAny) tissue.kind[t] = Tissue::kNone;
}

std::string list(const std::set<Label>& labels) {
  std::string text;
  for (const Label label : labels) text += (text.empty() ? "" : ", ") + std::to_string(label);
  return text;
}

}  // namespace

Result<Tissue> make_tissue(const TetMesh& mesh, const LabelTransfer& transfer, const TissueParams& params) {
  const Result<KindOfLabel> kinds = kinds_of_labels(params);
  if (!kinds) return kinds.error();
  if (params.by != TissueBy::kMesh && transfer.labels.empty())
    return tissue_error(
        ".by", "found no transferred label to take tissue from, expected transfer.labels to name some");
  Tissue tissue;
  for (const TissueLabels& kind : params.kinds) tissue.kinds.push_back(kind);
  std::set<Label> met;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    Label label = mesh.labels[t];
    if (params.by == TissueBy::kCentroid) label = static_cast<Label>(transfer.centroid()[t]);
    if (params.by == TissueBy::kMajority) label = static_cast<Label>(transfer.majority()[t]);
    met.insert(label);
    tissue.kind.push_back(kind_of(*kinds, label));
  }
  if (params.by == TissueBy::kFraction) mix(transfer, *kinds, tissue);
  if (std::all_of(tissue.kind.begin(), tissue.kind.end(), [](auto kind) { return kind == Tissue::kNone; }))
    return tissue_error(
        ".kinds", "found no tetrahedron of their labels, expected some of those of the mesh: " + list(met));
  return tissue;
}

}  // namespace voxtet
