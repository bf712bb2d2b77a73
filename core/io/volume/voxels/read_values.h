// Typed voxel bytes, or numbers written as text -> values, block by block.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "io/bytes/byte_source.h"
#include "io/volume/voxels/reading.h"
#include "io/volume/voxels/voxel_layout.h"

namespace voxtet {

/// Takes the values of a file in its order.
class ValueSink {
 public:
  virtual ~ValueSink() = default;
  /// So many more will come, or an error: the file has the bytes for them. Called before memory is needed.
  virtual void expect(std::uint64_t count) = 0;
  virtual Status take(std::span<const double> values) = 0;
};

/// Gives a sink exactly the values of a checked layout, to the end of the source. Nothing is allocated before
/// the source is known to hold that many bytes (compressed: to be able to). Errors: kBadInput for too few or
/// too many bytes; those of the sink.
Status read_values(ByteSource& source, const VoxelLayout& layout, ValueSink& sink, Reading& reading);

/// The same from numbers written in decimal, separated by white space. White space must also follow the last
/// one: without it a number that was cut could not be told from a whole one.
Status read_text_values(std::span<const std::uint8_t> text, const VoxelLayout& layout, ValueSink& sink);

/// Keeps the values as they are, NaN and infinity included.
class ScalarSink : public ValueSink {
 public:
  void expect(std::uint64_t count) override { values.reserve(static_cast<std::size_t>(count)); }
  Status take(std::span<const double> block) override {
    for (const double value : block) values.push_back(static_cast<float>(value));
    return std::monostate{};
  }
  std::vector<float> values;
};

}  // namespace voxtet
