#include "physics/mechanics/materials/material.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <initializer_list>
#include <sstream>
#include <type_traits>
#include <utility>

#include "base/portable_exp.h"
#include "physics/mechanics/materials/corotational.h"

namespace voxtet::mechanics {
namespace {

/// Of the numbers of Tensor6.
constexpr std::array<std::pair<int, int>, 6> kPlaces{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};

/// (a_ik a_jl + a_il a_jk) / 2: for a = C^-1 it is -dC^-1/dC, for a = I the identity.
Tensor66 symmetric_square(const Eigen::Matrix3d& a) {
  Tensor66 out;
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 6; ++c) {
      const auto [i, j] = kPlaces[static_cast<std::size_t>(r)];
      const auto [k, l] = kPlaces[static_cast<std::size_t>(c)];
      out(r, c) = (a(i, k) * a(j, l) + a(i, l) * a(j, k)) / 2;
    }
  return out;
}

Tensor66 both_ways(const Tensor6& a, const Tensor6& b) {
  return a * b.transpose() + b * a.transpose();
}

/// A function of C, its first and its second derivative.
struct Invariant {
  double value;
  Tensor6 gradient;
  Tensor66 hessian;
};

/// I1' and I2'.
std::array<Invariant, 2> isochoric(const Eigen::Matrix3d& c) {
  const Eigen::Matrix3d inverse = c.inverse();
  const Tensor6 ci = tensor6(inverse), one = tensor6(Eigen::Matrix3d::Identity()), c6 = tensor6(c);
  const Tensor66 cici = ci * ci.transpose(), square = symmetric_square(inverse);
  const double m = portable_exp(-portable_log(c.determinant()) / 3), m2 = m * m;  // J^-2/3
  const double i1 = c.trace(), i2 = (i1 * i1 - c.squaredNorm()) / 2;
  const Tensor6 di2 = i1 * one - c6;
  return {{{m * i1, m * (one - i1 / 3 * ci), m * (i1 / 9 * cici + i1 / 3 * square - both_ways(one, ci) / 3)},
           {m2 * i2, m2 * (di2 - 2 * i2 / 3 * ci),
            m2 * (one * one.transpose() - symmetric_square(Eigen::Matrix3d::Identity()) -
                  2.0 / 3 * both_ways(di2, ci) + 4 * i2 / 9 * cici + 2 * i2 / 3 * square)}}};
}

/// A function of one number with two derivatives.
struct Curve {
  double value, first, second;
};

/// a / 2b (exp(b x^2) - 1)
Curve stiffening(double a, double b, double x) {
  const double e = portable_exp(b * x * x);
  return {a / (2 * b) * (e - 1), a * x * e, a * e * (1 + 2 * b * x * x)};
}

/// Times 1 / (1 + exp(-k x)).
Curve switched(const Curve& g, double k, double x) {
  const double on = 1 / (1 + portable_exp(-k * x));
  const double slope = k * on * (1 - on), bend = k * slope * (1 - 2 * on);
  return {on * g.value, slope * g.value + on * g.first, bend * g.value + 2 * slope * g.first + on * g.second};
}

void add(const Curve& w, const Invariant& of, Response& response) {
  response.energy_kpa += w.value;
  response.stress += 2 * w.first * of.gradient;
  response.tangent += 4 * (w.second * of.gradient * of.gradient.transpose() + w.first * of.hessian);
}

/// The same for a . C b, whose second derivative is 0.
void add_linear(const Curve& w, const Tensor6& gradient, Response& response) {
  response.energy_kpa += w.value;
  response.stress += 2 * w.first * gradient;
  response.tangent += 4 * w.second * gradient * gradient.transpose();
}

Tensor6 along(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return tensor6((a * b.transpose() + b * a.transpose()) / 2);
}

void add_isotropic(double c1, double c2, const Eigen::Matrix3d& c, Response& response) {
  const auto [i1, i2] = isochoric(c);
  add({c1 * (i1.value - 3), c1, 0}, i1, response);
  add({c2 * (i2.value - 3), c2, 0}, i2, response);
}

Response respond(const MooneyRivlin& m, const Eigen::Matrix3d& c, const Eigen::Matrix3d&) {
  Response response;
  add_isotropic(m.c1_kpa, m.c2_kpa, c, response);
  return response;
}

Response respond(const TransverselyIsotropic& m, const Eigen::Matrix3d& c, const Eigen::Matrix3d& frame) {
  Response response;
  add_isotropic(m.c1_kpa, m.c2_kpa, c, response);
  const Eigen::Vector3d f = frame.col(0);
  const double stretch = f.dot(c * f) - 1;
  if (stretch > 0) add_linear(stiffening(m.a_f_kpa, m.b_f, stretch), along(f, f), response);
  return response;
}

Response respond(const HolzapfelOgden& m, const Eigen::Matrix3d& c, const Eigen::Matrix3d& frame) {
  Response response;
  const Invariant i1 = isochoric(c)[0];
  const double e = portable_exp(m.b * (i1.value - 3));
  add({m.a_kpa / (2 * m.b) * (e - 1), m.a_kpa / 2 * e, m.a_kpa * m.b / 2 * e}, i1, response);
  const auto add_fibres = [&](double a, double b, const Eigen::Vector3d& f) {
    const double stretch = f.dot(c * f) - 1;
    add_linear(switched(stiffening(a, b, stretch), m.k, stretch), along(f, f), response);
  };
  const Eigen::Vector3d f = frame.col(0), s = frame.col(1);
  add_fibres(m.a_f_kpa, m.b_f, f);
  add_fibres(m.a_s_kpa, m.b_s, s);
  add_linear(stiffening(m.a_fs_kpa, m.b_fs, f.dot(c * s)), along(f, s), response);
  return response;
}

Response respond(const Guccione& m, const Eigen::Matrix3d& c, const Eigen::Matrix3d& frame) {
  const Eigen::Matrix3d e = (frame.transpose() * c * frame - Eigen::Matrix3d::Identity()) / 2;
  Eigen::Matrix3d b;
  b << m.b_f, m.b_fs, m.b_fs, m.b_fs, m.b_t, m.b_t, m.b_fs, m.b_t, m.b_t;
  double q = 0;
  Tensor6 dq = Tensor6::Zero();
  Tensor66 ddq = Tensor66::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Tensor6 a = along(frame.col(i), frame.col(j));
      q += b(i, j) * e(i, j) * e(i, j);
      dq += 2 * b(i, j) * e(i, j) * a;
      ddq += 2 * b(i, j) * a * a.transpose();
    }
  const double w = m.c_kpa / 2 * portable_exp(q);
  return {w - m.c_kpa / 2, w * dq, w * (ddq + dq * dq.transpose())};
}

Response respond(const Corotational& m, const Eigen::Matrix3d& c, const Eigen::Matrix3d& frame) {
  return respond_corotational(m, c, frame);
}

struct Parameter {
  const char* name;
  double value;
};

std::optional<std::string> fault_among(std::initializer_list<Parameter> stiffnesses,
                                       std::initializer_list<Parameter> exponents) {
  const auto fault = [](const Parameter& found, const char* expected) {
    std::ostringstream text;
    text << found.name << ": found " << found.value << ", expected a finite number " << expected;
    return text.str();
  };
  for (const Parameter& p : stiffnesses)
    if (!(std::isfinite(p.value) && p.value >= 0)) return fault(p, "not below 0 kPa");
  for (const Parameter& p : exponents)
    if (!(std::isfinite(p.value) && p.value > 0)) return fault(p, "above 0");
  return std::nullopt;
}

std::optional<std::string> fault_in(const MooneyRivlin& m) {
  return fault_among({{"c1_kpa", m.c1_kpa}, {"c2_kpa", m.c2_kpa}}, {});
}

std::optional<std::string> fault_in(const TransverselyIsotropic& m) {
  return fault_among({{"c1_kpa", m.c1_kpa}, {"c2_kpa", m.c2_kpa}, {"a_f_kpa", m.a_f_kpa}}, {{"b_f", m.b_f}});
}

std::optional<std::string> fault_in(const HolzapfelOgden& m) {
  return fault_among(
      {{"a_kpa", m.a_kpa}, {"a_f_kpa", m.a_f_kpa}, {"a_s_kpa", m.a_s_kpa}, {"a_fs_kpa", m.a_fs_kpa}},
      {{"b", m.b}, {"b_f", m.b_f}, {"b_s", m.b_s}, {"b_fs", m.b_fs}, {"k", m.k}});
}

std::optional<std::string> fault_in(const Guccione& m) {
  return fault_among({{"c_kpa", m.c_kpa}}, {{"b_f", m.b_f}, {"b_t", m.b_t}, {"b_fs", m.b_fs}});
}

std::optional<std::string> fault_in(const Corotational& m) {
  return fault_among({{"shear_across_kpa", m.shear_across_kpa},
                      {"shear_along_kpa", m.shear_along_kpa},
                      {"fibre_kpa", m.fibre_kpa}},
                     {});
}

}  // namespace

Tensor6 tensor6(const Eigen::Matrix3d& a) {
  Tensor6 out;
  out << a(0, 0), a(1, 1), a(2, 2), a(0, 1), a(1, 2), a(0, 2);
  return out;
}

Eigen::Matrix3d matrix_of(const Tensor6& t) {
  Eigen::Matrix3d out;
  out << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
  return out;
}

std::optional<std::string> fault_of(const Material& material) {
  return std::visit([](const auto& m) { return fault_in(m); }, material);
}

Response response_of(const Material& material, const Eigen::Matrix3d& c, const Eigen::Matrix3d& frame) {
  return std::visit([&](const auto& m) { return respond(m, c, frame); }, material);
}

Material scaled(const Material& material, double factor) {
  return std::visit(
      [factor](auto out) -> Material {
        using T = decltype(out);
        if constexpr (std::is_same_v<T, MooneyRivlin>) {
          out.c1_kpa *= factor, out.c2_kpa *= factor;
        } else if constexpr (std::is_same_v<T, TransverselyIsotropic>) {
          out.c1_kpa *= factor, out.c2_kpa *= factor, out.a_f_kpa *= factor;
        } else if constexpr (std::is_same_v<T, HolzapfelOgden>) {
          out.a_kpa *= factor, out.a_f_kpa *= factor, out.a_s_kpa *= factor, out.a_fs_kpa *= factor;
        } else if constexpr (std::is_same_v<T, Corotational>) {
          out.shear_across_kpa *= factor, out.shear_along_kpa *= factor, out.fibre_kpa *= factor;
        } else {
          out.c_kpa *= factor;
        }
        return out;
      },
      material);
}

double mean_shear_modulus_kpa(const Material& material) {
  const Tensor66 d = response_of(material, Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity()).tangent;
  return (d.diagonal().head<3>().sum() + 2 * d.diagonal().tail<3>().sum() -
          d.topLeftCorner<3, 3>().sum() / 3) /
         10;
}

void add_active_stress(double tension_kpa, const Eigen::Vector3d& fibre, Response& response) {
  response.stress += tension_kpa * along(fibre, fibre);
}

void add_viscous_stress(double kpa, const Eigen::Matrix3d& change_of_strain, Response& response) {
  response.stress += kpa * tensor6(change_of_strain);
  response.tangent += kpa * symmetric_square(Eigen::Matrix3d::Identity());
}

Volumetric volumetric(double bulk_kpa, double j) {
  return {bulk_kpa / 4 * (j * j - 1 - 2 * portable_log(j)), bulk_kpa / 2 * (j - 1 / j),
          bulk_kpa / 2 * (1 + 1 / (j * j))};
}

Dilation dilation(double bulk_kpa, double pressure_kpa) {
  // J - 1 / J = 2 q; the root that is above 0, without a difference of large numbers.
  const double q = pressure_kpa / bulk_kpa, root = std::sqrt(1 + q * q);
  const double j = q > 0 ? root + q : 1 / (root - q);
  return {pressure_kpa * (j - 1) - volumetric(bulk_kpa, j).energy_kpa, j, j / (bulk_kpa * root)};
}

void add_pressure(double pressure_kpa, double modulus_kpa, const Eigen::Matrix3d& c, double j,
                  Response& response) {
  const Eigen::Matrix3d inverse = c.inverse();
  const Tensor6 ci = tensor6(inverse);
  const double pj = pressure_kpa * j;
  response.stress += pj * ci;
  response.tangent += (modulus_kpa * j * j + pj) * ci * ci.transpose() - 2 * pj * symmetric_square(inverse);
}

}  // namespace voxtet::mechanics
