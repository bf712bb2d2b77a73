// The tags of an XML file, one after another, with the text between them.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace voxtet {

/// All views point into the file.
struct XmlTag {
  std::string_view name;
  std::vector<std::pair<std::string_view, std::string_view>> attributes;
  bool closing = false, empty = false;

  /// The value of an attribute; empty where there is none.
  std::string_view operator[](std::string_view attribute) const;
};

/// Strict for what it reads (attributes in quotes, tags closed where they were opened); knows no entities,
/// CDATA or DTD.
class XmlTags {
 public:
  /// `root`: name of the tag that the file must begin with.
  XmlTags(std::string_view file, std::string_view root) : file_(file), root_(root) {}

  const std::string& error() const { return error_; }
  std::size_t position() const { return at_; }
  /// Records "line 12: message"; always false.
  bool fail(const std::string& message);
  /// The next tag and the text before it; comments and declarations are passed over. False at a failure.
  bool next(XmlTag& tag, std::string_view& text);
  /// Name of the tag around the last one; empty where that is the root.
  std::string_view parent() const { return parent_; }
  /// Whether the root is closed.
  bool at_end() const { return open_.empty(); }

 private:
  bool begins(std::string_view text) const { return file_.substr(at_, text.size()) == text; }
  bool skip_behind(std::string_view marker);
  void skip_space();
  std::string_view read_name();
  bool read_tag(XmlTag& tag);
  bool nest(const XmlTag& tag);

  std::string_view file_, root_, parent_;
  std::vector<std::string_view> open_;
  std::size_t at_ = 0;
  std::string error_;
};

}  // namespace voxtet
