// How the file of a volume is to be read, and what its reader says of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace voxtet {

/// The unit of a file's lengths.
enum class LengthUnit { kOfFile, kMetre, kCentimetre, kMillimetre, kMicrometre, kNanometre };

/// What a file leaves open, or says wrongly. The defaults are right for most files.
struct ReadOptions {
  LengthUnit unit = LengthUnit::kOfFile;  ///< of its lengths, whatever it says itself
  /// Segments by their names or labels: where segments overlap, the first of these wins. Those that are not
  /// named come behind them, the last of the file first.
  std::vector<std::string> precedence;
  std::int64_t background = 0;  ///< the value of the background
  std::int32_t frame = -1;      ///< of a file with several, from 0; -1: none has been chosen

  bool operator==(const ReadOptions&) const = default;
};

/// What is said of a file that could be read.
struct ReadRemarks {
  std::vector<std::string> warnings;  ///< what may be wrong in the volume
  std::vector<std::string> notes;     ///< what was done, although nothing is wrong
};

}  // namespace voxtet
