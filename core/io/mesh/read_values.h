// Values at the points of a mesh, from the files that openCARP writes beside it: .dat and .igb.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/bytes/bytes.h"
#include "io/mesh/shared/igb_header.h"
#include "types/field.h"
#include "types/result.h"

namespace voxtet {

/// One value for each element of one kind, at one time (.dat) or at some (.igb). The numbers of an .igb stay
/// as they are in the file until a frame is asked for, since there may be many.
class PointValues {
 public:
  /// .dat: finite numbers as text, one after another. Where no other is below 0, -1 means none, as openCARP
  /// writes for a point that was never activated. .igb: igb_header.h. The format is found from the name.
  /// Strict: errors are kBadInput naming the file, the field or frame, what was found and what was expected.
  static Result<PointValues> open(std::string file, Bytes bytes);

  const std::string& file() const { return file_; }
  std::size_t count() const { return count_; }  ///< values of a frame
  /// Fails unless there is a value for each of `points` points; the message names the file and both numbers.
  Status check_count(std::size_t points) const;
  /// Times of the frames, ascending; a .dat has none, and one frame.
  const std::vector<double>& times_ms() const { return times_ms_; }
  std::size_t frames() const { return times_ms_.empty() ? 1 : times_ms_.size(); }

  /// Its name is the last word of the file's: `activation_ms` of "heart.activation_ms.dat".
  Result<Field> frame(std::size_t k) const;

 private:
  std::string file_, unit_;
  std::size_t count_ = 0;
  std::vector<double> times_ms_;
  std::vector<float> values_;  ///< of a .dat
  IgbHeader header_;           ///< of an .igb
  Bytes bytes_;
};

}  // namespace voxtet
