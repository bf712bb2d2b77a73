#include "io/mesh/read/shared/mesh_cursor.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "io/bytes/header_text.h"
#include "io/bytes/text_numbers.h"

namespace voxtet {

MeshCursor::MeshCursor(std::span<const std::uint8_t> bytes, std::string file, std::string reader,
                       char comment)
    : begin_(reinterpret_cast<const char*>(bytes.data())),
      at_(begin_),
      end_(begin_ + bytes.size()),
      file_(std::move(file)),
      reader_(std::move(reader)),
      comment_(comment) {}

void MeshCursor::fail(const std::string& message) {
  if (!error_) {
    const std::string place = binary_ ? "byte " + std::to_string(at_ - begin_)
                                      : "line " + std::to_string(1 + std::count(begin_, at_, '\n'));
    error_ = Error{ErrorCode::kBadInput, reader_, file_ + ": " + place + ": " + message, {}};
  }
  at_ = end_;
}

void MeshCursor::fail_in_line(std::size_t line, const std::string& message) {
  if (!error_)
    error_ =
        Error{ErrorCode::kBadInput, reader_, file_ + ": line " + std::to_string(line) + ": " + message, {}};
  at_ = end_;
}

bool MeshCursor::can_hold(std::uint64_t count, std::uint64_t bytes_each, const char* items) {
  if (!ok()) return false;
  if (count <= left() / bytes_each) return true;
  fail("the file says " + std::to_string(count) + " " + items + ", but only " + std::to_string(left()) +
       " bytes follow");
  return false;
}

void MeshCursor::skip_space() {
  while (at_ != end_) {
    if (is_space(*at_)) {
      ++at_;
    } else if (comment_ != '\0' && *at_ == comment_) {
      at_ = std::find(at_, end_, '\n');
    } else {
      return;
    }
  }
}

bool MeshCursor::at_end() {
  skip_space();
  return at_ == end_;
}

bool MeshCursor::at_line_end() {
  while (at_ != end_ && *at_ != '\n' && is_space(*at_)) ++at_;
  return at_ == end_ || *at_ == '\n' || (comment_ != '\0' && *at_ == comment_);
}

void MeshCursor::expect_end(const char* what) {
  if (!ok()) return;
  if (at_ == end_)
    fail(std::string("the file ends inside the line of ") + what);
  else if (!at_end())
    fail("found " + in_quotes(peek_word()) + " behind " + what);
}

std::string_view MeshCursor::peek_word() {
  skip_space();
  const char* end = at_;
  while (end != end_ && !is_space(*end)) ++end;
  return {at_, static_cast<std::size_t>(end - at_)};
}

std::string_view MeshCursor::word(const char* what) {
  const std::string_view result = peek_word();
  if (result.empty()) ended(what);
  at_ += std::min(result.size(), left());
  return result;
}

std::string_view MeshCursor::rest_of_line() {
  const char* stop = std::find(at_, end_, '\n');
  const std::string_view line(at_, static_cast<std::size_t>(stop - at_));
  at_ = stop == end_ ? end_ : stop + 1;
  return trimmed(line);
}

bool MeshCursor::next_line_begins(std::string_view text) const {
  const char* stop = std::find(at_, end_, '\n');
  return stop != end_ &&
         std::string_view(stop + 1, static_cast<std::size_t>(end_ - stop - 1)).starts_with(text);
}

std::int64_t MeshCursor::integer(const char* what, std::int64_t lo, std::int64_t hi) {
  const std::string_view text = peek_word();
  if (text.empty()) {
    ended(what);
    return 0;
  }
  std::int64_t value = 0;
  const auto [stop, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc{} || stop != text.data() + text.size() || value < lo || value > hi) {
    fail(std::string(what) + " is " + in_quotes(text) + ", expected an integer from " + std::to_string(lo) +
         " to " + std::to_string(hi));
    return 0;
  }
  at_ += text.size();
  return value;
}

double MeshCursor::real(const char* what) {
  const std::string_view text = peek_word();
  if (text.empty()) {
    ended(what);
    return 0;
  }
  double value = 0;
  if (!parse_real(text, value)) {
    fail(std::string(what) + " is " + in_quotes(text) + ", expected a finite number");
    return 0;
  }
  at_ += text.size();
  return value;
}

void MeshCursor::expect(std::string_view wanted) {
  const std::string_view found = peek_word();
  if (found != wanted) {
    fail("expected " + std::string(wanted) +
         (found.empty() ? ", the file ends" : ", found " + in_quotes(found)));
    return;
  }
  at_ += found.size();
}

void MeshCursor::skip_behind(std::string_view marker) {
  const std::size_t found = std::string_view(at_, left()).find(marker);
  if (found == std::string_view::npos) {
    fail("no " + std::string(marker) + " follows");
    return;
  }
  at_ += found + marker.size();
}

void MeshCursor::skip_bytes(std::uint64_t count, const char* what) {
  binary_ = true;
  if (count > left()) {
    ended(what);
    return;
  }
  at_ += count;
}

void add_label_name(std::int64_t label, std::string_view name, std::vector<LabelInfo>& infos) {
  if (label < 1 || label > std::numeric_limits<Label>::max()) return;
  if (trimmed(name).empty() || name == "label " + std::to_string(label)) return;
  const auto place = std::lower_bound(infos.begin(), infos.end(), label,
                                      [](const LabelInfo& info, std::int64_t l) { return info.label < l; });
  if (place != infos.end() && place->label == label) return;
  infos.insert(place, {static_cast<Label>(label), std::string(name), {-1.F, -1.F, -1.F}});
}

Result<TetMesh> finish_mesh(MeshCursor& cursor, TetMesh mesh, bool lps) {
  if (cursor.ok() && mesh.tets.empty()) cursor.fail("no linear tetrahedra, expected at least one");
  if (!cursor.ok()) return cursor.error();
  if (lps)
    for (Eigen::Vector3d& p : mesh.points) p = Eigen::Vector3d(0.0 - p.x(), 0.0 - p.y(), p.z());
  return mesh;
}

}  // namespace voxtet
