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

/// Strict for what it reads (attributes in quotes); knows no entities, CDATA or DTD.
class XmlTags {
 public:
  explicit XmlTags(std::string_view file) : file_(file) {}

  const std::string& error() const { return error_; }
  std::size_t position() const { return at_; }
  /// Records "line 12: message"; always false.
  bool fail(const std::string& message);
  /// The next tag and the text before it; comments and declarations are passed over. False at a failure.
  bool next(XmlTag& tag, std::string_view& text);

 private:
  bool begins(std::string_view text) const { return file_.substr(at_, text.size()) == text; }
  bool skip_behind(std::string_view marker);
  void skip_space();
  std::string_view read_name();
  bool read_tag(XmlTag& tag);

  std::string_view file_;
  std::size_t at_ = 0;
  std::string error_;
};

}  // namespace voxtet
