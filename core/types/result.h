// Errors are values across every stage boundary: a stage returns Result<T>, either its value or an Error.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "types/field.h"

namespace voxtet {

/// What kind of failure an Error is. The command line turns it into an exit code, the browser into a title.
enum class ErrorCode {
  kUsage,        ///< the request itself is malformed (command line, recipe field)
  kBadInput,     ///< a file or volume cannot be read or makes no sense
  kMeshing,      ///< a stage could not produce a valid mesh
  kDiffers,      ///< a reproduced digest is not the expected one
  kOutOfMemory,  ///< memory or a limit of the recipe was exceeded
  kCancelled,    ///< the caller asked to stop
  kInternal,     ///< an invariant of voxtet itself broke
};

/// Stable lower-case name of a code, as it stands in JSON ("bad_input").
std::string to_string(ErrorCode code);

/// Where an error is, so that a viewer can show it. Points in mm, RAS. `elements` are indices of elements of
/// kind `on` in the result of `stage`; empty if no result that a viewer has contains them.
struct ErrorPlace {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::uint32_t> elements;
  std::string stage{};
  On on = On::kTriangles;
};

struct Error {
  ErrorCode code = ErrorCode::kInternal;
  std::string stage;    ///< the stage or reader that failed, e.g. "tetra", "read_nifti"
  std::string message;  ///< which file, field or region; what was found; what was expected
  ErrorPlace where;
};

/// The error of a request that is itself malformed.
inline Error usage_error(std::string stage, std::string message) {
  return {ErrorCode::kUsage, std::move(stage), std::move(message), {}};
}

/// A T or an Error. `value()` may only be called when `ok()`.
template <class T>
class Result {
 public:
  Result(T value) : state_(std::move(value)) {}
  Result(Error error) : state_(std::move(error)) {}

  bool ok() const { return std::holds_alternative<T>(state_); }
  explicit operator bool() const { return ok(); }
  T& value() & { return std::get<T>(state_); }
  const T& value() const& { return std::get<T>(state_); }
  T&& value() && { return std::get<T>(std::move(state_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  const Error& error() const { return std::get<Error>(state_); }

 private:
  std::variant<T, Error> state_;
};

/// The result of a function with nothing to return.
using Status = Result<std::monostate>;

}  // namespace voxtet
