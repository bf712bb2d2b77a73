#include "io/mesh/read/vtu_xml.h"

#include <algorithm>

#include "io/bytes/header_text.h"

namespace voxtet {
namespace {

struct Tag {
  std::string_view name;
  std::vector<std::pair<std::string_view, std::string_view>> attributes;
  bool closing = false, empty = false;

  std::string_view operator[](std::string_view attribute) const {
    for (const auto& [key, value] : attributes)
      if (key == attribute) return value;
    return {};
  }
};

bool is_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == '.' || c == ':';
}

/// Splits the file into tags and the text between them.
class TagReader {
 public:
  explicit TagReader(std::string_view file) : file_(file) {}

  const std::string& error() const { return error_; }
  std::size_t position() const { return at_; }
  bool fail(const std::string& message) {
    const auto lines = std::count(file_.begin(), file_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    error_ = "line " + std::to_string(lines + 1) + ": " + message;
    return false;
  }

  /// The next tag and the text before it; comments and declarations are passed over. False at a failure.
  bool next(Tag& tag, std::string_view& text) {
    const std::size_t begin = at_;
    for (;;) {
      at_ = file_.find('<', at_);
      if (at_ == std::string_view::npos) {
        at_ = file_.size();
        return fail("the file ends inside the XML");
      }
      if (begins("<!--")) {
        if (!skip_behind("-->")) return false;
      } else if (begins("<?")) {
        if (!skip_behind("?>")) return false;
      } else {
        break;
      }
    }
    text = file_.substr(begin, at_ - begin);
    return read_tag(tag);
  }

 private:
  bool begins(std::string_view text) const { return file_.substr(at_, text.size()) == text; }
  bool skip_behind(std::string_view marker) {
    const std::size_t found = file_.find(marker, at_);
    if (found == std::string_view::npos) return fail("no " + std::string(marker) + " follows");
    at_ = found + marker.size();
    return true;
  }
  void skip_space() {
    while (at_ < file_.size() && is_space(file_[at_])) ++at_;
  }
  std::string_view read_name() {
    const std::size_t begin = at_;
    while (at_ < file_.size() && is_name(file_[at_])) ++at_;
    return file_.substr(begin, at_ - begin);
  }

  bool read_tag(Tag& tag) {
    tag = {};
    ++at_;
    if (begins("/")) {
      tag.closing = true;
      ++at_;
    }
    tag.name = read_name();
    if (tag.name.empty()) return fail("a tag without a name");
    for (;;) {
      skip_space();
      if (begins(">")) {
        ++at_;
        return true;
      }
      if (begins("/>")) {
        tag.empty = true;
        at_ += 2;
        return true;
      }
      const std::string_view key = read_name();
      skip_space();
      if (key.empty() || !begins("=")) return fail("tag " + in_quotes(tag.name) + " is not well formed");
      ++at_;
      skip_space();
      const char quote = at_ < file_.size() ? file_[at_] : '\0';
      const std::size_t stop =
          quote == '"' || quote == '\'' ? file_.find(quote, at_ + 1) : std::string_view::npos;
      if (stop == std::string_view::npos) return fail("attribute " + in_quotes(key) + " is not in quotes");
      tag.attributes.emplace_back(key, file_.substr(at_ + 1, stop - at_ - 1));
      at_ = stop + 1;
    }
  }

  std::string_view file_;
  std::size_t at_ = 0;
  std::string error_;
};

/// Puts tags into their places while a stack of open names checks the nesting.
class VtuBuilder {
 public:
  explicit VtuBuilder(std::string_view file) : file_(file), reader_(file) {}

  bool build() {
    Tag tag;
    std::string_view text;
    do {
      if (!reader_.next(tag, text)) return false;
      if (array_ != nullptr && array_->text.empty()) array_->text = trimmed(text);
      if (tag.closing) {
        if (!close(tag)) return false;
      } else if (!open(tag)) {
        return false;
      }
    } while (!open_.empty() && document.appended_encoding.empty());
    return true;
  }
  const std::string& error() const { return reader_.error(); }

  VtuDocument document;

 private:
  bool close(const Tag& tag) {
    if (open_.empty() || open_.back() != tag.name)
      return reader_.fail("</" + std::string(tag.name) + "> closes nothing");
    open_.pop_back();
    if (tag.name == "DataArray" || tag.name == "Array") array_ = nullptr;
    return true;
  }

  bool open(const Tag& tag) {
    const std::string_view parent = open_.empty() ? std::string_view{} : open_.back();
    if (open_.empty() && tag.name != "VTKFile")
      return reader_.fail("the first tag is " + in_quotes(tag.name) + ", expected VTKFile");
    if (tag.name == "VTKFile") {
      document.grid_type = tag["type"];
      document.byte_order = tag["byte_order"];
      document.header_type = tag["header_type"];
      document.compressor = tag["compressor"];
    } else if (tag.name == "Piece") {
      document.pieces.push_back({tag["NumberOfPoints"], tag["NumberOfCells"], {}});
    } else if (tag.name == "DataArray" || tag.name == "Array") {
      if (parent != "FieldData" && document.pieces.empty())
        return reader_.fail("an array outside of a Piece");
      auto& arrays = parent == "FieldData" ? document.field_data : document.pieces.back().arrays;
      arrays.push_back({parent,
                        tag["Name"],
                        tag["type"],
                        tag["format"],
                        tag["offset"],
                        tag["NumberOfComponents"],
                        tag["NumberOfTuples"],
                        {}});
      array_ = tag.empty ? nullptr : &arrays.back();
    } else if (tag.name == "AppendedData") {
      return open_appended(tag);
    }
    if (!tag.empty) open_.push_back(tag.name);
    return true;
  }

  bool open_appended(const Tag& tag) {
    document.appended_encoding = tag["encoding"];
    if (document.appended_encoding != "raw" && document.appended_encoding != "base64")
      return reader_.fail("AppendedData encoding " + in_quotes(document.appended_encoding) +
                          ", expected raw or base64");
    const std::size_t start = file_.find('_', reader_.position());
    if (start == std::string_view::npos ||
        !trimmed(file_.substr(reader_.position(), start - reader_.position())).empty())
      return reader_.fail("no \"_\" at the begin of AppendedData");
    document.appended = file_.substr(start + 1);
    return true;
  }

  std::string_view file_;
  TagReader reader_;
  std::vector<std::string_view> open_;
  VtuArray* array_ = nullptr;
};

}  // namespace

Result<VtuDocument> parse_vtu_xml(std::string_view file) {
  VtuBuilder builder(file);
  if (!builder.build()) return Error{ErrorCode::kBadInput, "read_vtu", builder.error(), {}};
  return std::move(builder.document);
}

}  // namespace voxtet
