// A cursor over the bytes of a mesh file, text or binary. The first failure sticks: from then on the cursor
// stands at the end and every read gives zero, so that callers need only ask `ok()` where a loop or an
// allocation depends on it.
#pragma once

#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "types/label_volume.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Most points or elements of a file: they are numbered in 32 bits.
inline constexpr std::int64_t kMostItems = 0xffffffff;

class MeshCursor {
 public:
  /// `reader` is the stage of errors, `comment` a character that hides the rest of a line ('\0': none).
  MeshCursor(std::span<const std::uint8_t> bytes, std::string file, std::string reader, char comment = '\0');

  bool ok() const { return !error_; }
  /// The first failure; only where !ok().
  const Error& error() const { return *error_; }
  /// Records the failure "file: line 12: message" ("byte 345" once something binary was read).
  void fail(const std::string& message);
  /// The same for a reader that takes lines by itself, counted from 1.
  void fail_in_line(std::size_t line, const std::string& message);

  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }
  /// Fails unless `count` items of at least `bytes_each` can still follow. Call it before memory is
  /// allocated.
  bool can_hold(std::uint64_t count, std::uint64_t bytes_each, const char* items);

  // Text. `what` names the field for messages.
  bool at_end();  ///< nothing but white space and comments is left
  bool at_line_end();
  /// For formats without an end mark: fails unless only white space is left, with at least a line end, since
  /// a number that ends the file may have been cut. `what` is the last item.
  void expect_end(const char* what);
  std::string_view word(const char* what);
  std::string_view peek_word();
  std::string_view rest_of_line();
  /// Whether the next line begins with a text. The cursor stays: binary data may stand there.
  bool next_line_begins(std::string_view text) const;
  std::int64_t integer(const char* what, std::int64_t lo, std::int64_t hi);
  double real(const char* what);
  void expect(std::string_view wanted);
  /// Moves behind the next occurrence of `marker`, wherever it stands. Fails where there is none.
  void skip_behind(std::string_view marker);

  // Binary, little-endian.
  template <class T>
  T raw(const char* what) {
    static_assert(std::is_arithmetic_v<T>);
    T value{};
    binary_ = true;
    if (left() < sizeof(T)) {
      ended(what);
      return value;
    }
    std::memcpy(&value, at_, sizeof(T));
    at_ += sizeof(T);
    if constexpr (std::is_floating_point_v<T>) {
      if (!(value - value == 0)) {
        fail(std::string(what) + " is not a finite number");
        return T{};
      }
    }
    return value;
  }
  void skip_bytes(std::uint64_t count, const char* what);

 private:
  void skip_space();
  void ended(const char* what) { fail(std::string("the file ends where ") + what + " is expected"); }

  const char *begin_, *at_, *end_;
  std::string file_, reader_;
  char comment_;
  bool binary_ = false;
  std::optional<Error> error_;
};

/// Adds the name that a file gives a label, in the order of labels. Not where the number is no label, has a
/// name already, or has the name that writers make up for one without ("label 5").
void add_label_name(std::int64_t label, std::string_view name, std::vector<LabelInfo>& infos);

/// Ends a reader: checks that there are tetrahedra, and turns LPS coordinates to RAS.
Result<TetMesh> finish_mesh(MeshCursor& cursor, TetMesh mesh, bool lps);

}  // namespace voxtet
