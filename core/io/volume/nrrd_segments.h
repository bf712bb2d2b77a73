// Segments of a .seg.nrrd: their names and colours, and layers flattened into one label map.
// Keys: 3D Slicer documentation, "Segmentations", SegmentN_Name, _Color, _LabelValue, _Layer.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "types/label_volume.h"
#include "types/result.h"

namespace voxtet {

struct NrrdSegment {
  LabelInfo info;  ///< `label` is the label in the volume that is returned
  std::int64_t layer = 0;
  Label value = 1;  ///< the value that the layer stores
};

/// The segments in order of their number, with labels made unique: a segment keeps its LabelValue unless an
/// earlier segment has it; then it gets the next number above all LabelValues. A missing Layer is 0, or the
/// segment's place where there are several layers; a missing LabelValue is 1. Errors: kBadInput for values
/// out of range, or two segments with the same value in the same layer.
Result<std::vector<NrrdSegment>> parse_segments(const std::map<std::string, std::string>& key_values,
                                                std::int64_t layers);

/// One label per voxel from `layers` values per voxel. Where segments overlap the later one wins, and
/// `warnings` gets a line for each pair that overlaps. Errors: kBadInput for a value other than 0 that
/// belongs to no segment (`size` is only used to name the voxel), and for segments that lose all their voxels
/// to later ones.
Result<std::vector<Label>> flatten_layers(const std::vector<Label>& values, std::int64_t layers,
                                          const std::vector<NrrdSegment>& segments,
                                          const std::array<std::int64_t, 3>& size,
                                          std::vector<std::string>& warnings);

/// Adds a warning for each segment without a voxel in `labels`.
void warn_of_empty_segments(const std::vector<Label>& labels, const std::vector<NrrdSegment>& segments,
                            std::vector<std::string>& warnings);

}  // namespace voxtet
