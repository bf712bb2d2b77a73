// Segments of a .seg.nrrd: their names and colours, and layers flattened into one label map.
// Keys: 3D Slicer documentation, "Segmentations", SegmentN_Name, _Color, _LabelValue, _Layer.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "io/volume/voxels/read_values.h"
#include "io/volume/voxels/reading.h"
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
/// segment's place where there are several layers; a missing LabelValue is 1. Where one colour is none, as of
/// 0 to 255, no segment gets any, and a note says so. Errors: kBadInput for values out of range, or two
/// segments with the same value in the same layer.
Result<std::vector<NrrdSegment>> parse_segments(const std::map<std::string, std::string>& key_values,
                                                std::int64_t layers, Reading& reading);

/// One label per voxel from `layers` values per voxel, which `feed` gives to a sink. Where segments overlap
/// the one wins that ReadOptions::precedence names first, and else the later one; a warning names each pair
/// that overlaps, and each segment that keeps no voxel or has none. Errors: kBadInput for a value other than
/// 0 that belongs to no segment, kUsage for a name in the precedence that none has.
Result<std::vector<Label>> read_segments(const VoxelLayout& layout, const std::vector<NrrdSegment>& segments,
                                         const std::function<Status(ValueSink&)>& feed, Reading& reading);

/// Warns of each segment that has no voxel in the labels of a file of one layer.
void warn_of_empty_segments(const std::vector<Label>& labels, const std::vector<NrrdSegment>& segments,
                            Reading& reading);

}  // namespace voxtet
