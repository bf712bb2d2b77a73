#include "io/volume/formats/nifti_affine.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "io/bytes/header_text.h"
#include "io/volume/voxels/length_unit.h"

namespace voxtet {
namespace {

constexpr const char* kSform = "the sform (srow_x, srow_y, srow_z)";
constexpr const char* kQform = "the qform (quatern, qoffset, pixdim)";

Result<double> mm_per_unit(std::int64_t xyzt_units, Reading& reading) {
  const std::int64_t code = xyzt_units & 7;
  reading.said_mm = code == 1 ? 1000 : code == 2 ? 1 : code == 3 ? 0.001 : 0;
  if (const auto asked = mm_per_unit_of(reading.options)) return *asked;
  if (code > 3)
    return bad_nifti("xyzt_units is " + std::to_string(xyzt_units) +
                     "; expected a spatial unit of 0 to 3, or " + kSayUnit);
  return code == 0 ? 1.0 : reading.said_mm;
}

Status check_pixdim(const NiftiHeader& h) {
  for (std::size_t d = 1; d <= 3; ++d)
    if (!(h.pixdim[d] > 0) || !std::isfinite(h.pixdim[d]))
      return bad_nifti("pixdim[" + std::to_string(d) + "] is " + number_text(h.pixdim[d]) +
                       "; expected a voxel size above 0");
  return std::monostate{};
}

Result<Eigen::Matrix4d> qform_of(const NiftiHeader& h) {
  const double qfac = h.pixdim[0];
  if (qfac != 1 && qfac != -1 && qfac != 0)
    return bad_nifti("pixdim[0] (qfac) is " + number_text(qfac) + "; expected 1 or -1");
  const double b = h.quatern[0], c = h.quatern[1], d = h.quatern[2];
  const double rest = 1 - (b * b + c * c + d * d);
  // Written so that NaN fails. The components are stored in single precision, in both directions of rounding.
  if (!(rest >= -3 * static_cast<double>(std::numeric_limits<float>::epsilon())))
    return bad_nifti("quatern_b, quatern_c, quatern_d have the squared length " + number_text(1 - rest) +
                     "; expected at most 1");
  const double a = std::sqrt(std::max(rest, 0.0));
  const double s = 2 / (a * a + b * b + c * c + d * d);
  Eigen::Matrix3d rotation;
  rotation << 1 - s * (c * c + d * d), s * (b * c - a * d), s * (b * d + a * c),  //
      s * (b * c + a * d), 1 - s * (b * b + d * d), s * (c * d - a * b),          //
      s * (b * d - a * c), s * (c * d + a * b), 1 - s * (b * b + c * c);
  Eigen::Matrix4d affine = Eigen::Matrix4d::Identity();
  const Eigen::Vector3d spacing(h.pixdim[1], h.pixdim[2], qfac < 0 ? -h.pixdim[3] : h.pixdim[3]);
  affine.topLeftCorner<3, 3>() = rotation * spacing.asDiagonal();
  affine.topRightCorner<3, 1>() << h.qoffset[0], h.qoffset[1], h.qoffset[2];
  return affine;
}

Eigen::Matrix4d sform_of(const NiftiHeader& h, double scale) {
  Eigen::Matrix4d affine = Eigen::Matrix4d::Identity();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      affine(row, column) = scale * h.srow[static_cast<std::size_t>(4 * row + column)];
  return affine;
}

/// The qform, if it is an affine that could be used.
Result<Eigen::Matrix4d> good_qform(const NiftiHeader& h, double scale) {
  if (h.qform_code == 0) return bad_nifti("qform_code is 0");
  if (Status positive = check_pixdim(h); !positive) return positive.error();
  Result<Eigen::Matrix4d> affine = qform_of(h);
  if (!affine) return affine;
  affine->topRows<3>() *= scale;
  if (Status good = check_affine(kNiftiReader, kQform, *affine); !good) return good.error();
  return affine;
}

Result<Eigen::Matrix4d> centred_on_pixdim(const NiftiHeader& h, double scale) {
  if (Status positive = check_pixdim(h); !positive) return positive.error();
  Eigen::Matrix4d affine = Eigen::Matrix4d::Identity();
  for (int d = 0; d < 3; ++d) {
    const auto n = static_cast<std::size_t>(d + 1);
    affine(d, d) = d == 0 ? -h.pixdim[n] : h.pixdim[n];
    affine(d, 3) = -affine(d, d) * static_cast<double>(h.dim[n] - 1) / 2;
  }
  affine.topRows<3>() *= scale;
  if (Status good = check_affine(kNiftiReader, "pixdim", affine); !good) return good.error();
  return affine;
}

/// "12.3"
std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value < 10 ? "%.2g" : "%.0f", value);
  return text;
}

/// Warns where two affines place the corners of the image apart.
void compare_forms(const NiftiHeader& h, const Eigen::Matrix4d& sform, const Eigen::Matrix4d& qform,
                   Reading& reading) {
  double apart = 0;
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector4d index(0, 0, 0, 1);
    for (int d = 0; d < 3; ++d)
      if ((corner >> d & 1) != 0) index[d] = static_cast<double>(h.dim[static_cast<std::size_t>(d + 1)] - 1);
    apart = std::max(apart, ((sform - qform) * index).norm());
  }
  const Eigen::Matrix3d s = sform.topLeftCorner<3, 3>(), q = qform.topLeftCorner<3, 3>();
  const double voxel = s.colwise().norm().minCoeff();
  if (apart <= 0.1 * voxel) return;
  const double trace = (s.colwise().normalized().transpose() * q.colwise().normalized()).trace();
  const double degrees = std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0)) * 180 / std::acos(-1.0);
  const bool mirrored = (s.determinant() < 0) != (q.determinant() < 0);
  reading.warn("sform and qform differ by up to " + rounded(apart) + " mm and " +
               (mirrored ? std::string("a reflection") : rounded(degrees) + " degrees") +
               "; the sform is used");
}

/// Where there is a sform by its code.
Result<Eigen::Matrix4d> sform_or_qform(const NiftiHeader& h, double scale, Reading& reading) {
  const Eigen::Matrix4d sform = sform_of(h, scale);
  const Result<Eigen::Matrix4d> qform = good_qform(h, scale);
  if (qform && sform.topLeftCorner<3, 3>().isZero(0)) {
    reading.note("the sform is all zeros; the qform is used");
    return *qform;
  }
  if (Status good = check_affine(kNiftiReader, kSform, sform); !good) return good.error();
  if (qform) compare_forms(h, sform, *qform, reading);
  return sform;
}

}  // namespace

Result<Eigen::Matrix4d> nifti_affine(const NiftiHeader& h, Reading& reading) {
  for (const auto& [name, code] :
       {std::pair("sform_code", h.sform_code), std::pair("qform_code", h.qform_code)})
    if (code < 0 || code > 5)
      return bad_nifti(std::string(name) + " is " + std::to_string(code) + "; expected 0 to 5");
  const Result<double> scale = mm_per_unit(h.units, reading);
  if (!scale) return scale.error();
  if (h.sform_code > 0) return sform_or_qform(h, *scale, reading);
  return h.qform_code > 0 ? good_qform(h, *scale) : centred_on_pixdim(h, *scale);
}

}  // namespace voxtet
