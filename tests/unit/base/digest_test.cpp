#include "base/digest.h"

#include <gtest/gtest.h>

namespace voxtet {
namespace {

std::string sha(std::string_view text) {
  Sha256 s;
  s.update(text);
  return s.hex();
}

TEST(Digest, MatchesThePublishedVectors) {  // FIPS 180-4 examples
  EXPECT_EQ(sha(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Digest, DoesNotDependOnHowTheBytesArrive) {
  const std::string text(1000, 'x');
  for (const std::size_t cut : {1u, 55u, 56u, 63u, 64u, 65u, 500u}) {
    Sha256 s;
    s.update(std::string_view(text).substr(0, cut));
    s.update(std::string_view(text).substr(cut));
    EXPECT_EQ(s.hex(), sha(text)) << cut;
  }
}

TEST(Digest, SeesPointsTetsAndLabels) {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.labels = {1};
  const std::string start = digest_of(mesh);
  TetMesh other = mesh;
  other.points[3].z() = std::nextafter(1.0, 2.0);
  EXPECT_NE(digest_of(other), start);
  other = mesh;
  other.labels[0] = 2;
  EXPECT_NE(digest_of(other), start);
}

}  // namespace
}  // namespace voxtet
