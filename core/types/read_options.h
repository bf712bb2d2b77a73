// How the file of a volume is to be read, and what its reader says of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace voxtet {

/// The unit of a file's lengths.
enum class LengthUnit { kOfFile, kMetre, kCentimetre, kMillimetre, kMicrometre, kNanometre };

/// The values of an image that are inside of what is meshed, both ends included.
struct Threshold {
  double lower = 0;
  double upper = 0;

  bool operator==(const Threshold&) const = default;
};

/// What a file leaves open, or says wrongly. The defaults are right for most files.
struct ReadOptions {
  LengthUnit unit = LengthUnit::kOfFile;  ///< of its lengths, whatever it says itself
  /// Segments by their names or labels: where segments overlap, the first of these wins. Those that are not
  /// named come behind them, the last of the file first.
  std::vector<std::string> precedence;
  std::int64_t background = 0;         ///< the value of the background
  std::int32_t frame = -1;             ///< of a file with several, from 0; -1: none has been chosen
  std::optional<Threshold> threshold;  ///< of an image that holds no labels: what is within becomes label 1

  bool operator==(const ReadOptions&) const = default;
};

/// What is said of a file that could be read.
struct ReadRemarks {
  std::vector<std::string> warnings;  ///< what may be wrong in the volume
  std::vector<std::string> notes;     ///< what was done, although nothing is wrong
};

}  // namespace voxtet
