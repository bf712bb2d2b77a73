#include "physics/beat/energy_account.h"

#include <utility>

namespace voxtet::beat {
namespace {

constexpr double kMilli = 1e-3;  ///< mN mm = uJ; kPa ml = mJ

double form(const fem::SparseMatrix& matrix, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  Eigen::VectorXd product;
  fem::multiply(matrix, b, product);
  return fem::dot(a, product);
}

}  // namespace

double EnergyAccount::kinetic(const HeartMotion& motion) const {
  return kMilli * form(heart_->mass, motion.velocity, motion.velocity) / 2;
}

Result<double> EnergyAccount::stored(const HeartMotion& motion) const {
  const Result<double> muscle = heart_->body.energy(motion.u);
  if (!muscle) return muscle.error();
  return kMilli * (*muscle + form(heart_->springs, motion.u, motion.u) / 2);
}

Result<Eigen::VectorXd> EnergyAccount::active(const HeartMotion& motion) const {
  Eigen::VectorXd with = Eigen::VectorXd::Zero(motion.u.size()), without = with;
  if (!heart_->tension_kpa) return with;
  if (Status added = heart_->body.add_forces(motion.u, heart_->tension_kpa(motion.time_s), with, nullptr);
      !added)
    return added.error();
  if (Status added = heart_->body.add_forces(motion.u, {}, without, nullptr); !added) return added.error();
  return Eigen::VectorXd(with - without);
}

Result<EnergyAccount> EnergyAccount::start(const Heart& heart, const HeartMotion& first) {
  EnergyAccount out(heart);
  out.last_ = first;
  const Result<double> stored = out.stored(first);
  if (!stored) return stored.error();
  Result<Eigen::VectorXd> active = out.active(first);
  if (!active) return active.error();
  out.first_stored_ = *stored;
  out.first_kinetic_ = out.kinetic(first);
  out.last_active_ = std::move(active).value();
  return out;
}

Status EnergyAccount::add(const HeartMotion& motion) {
  Result<Eigen::VectorXd> active = this->active(motion);
  if (!active) return active.error();
  const Result<double> stored = this->stored(motion);
  if (!stored) return stored.error();
  const double step = motion.time_s - last_.time_s;
  Eigen::VectorXd with = Eigen::VectorXd::Zero(motion.u.size()), without = with;
  const mechanics::StrainRate rate{last_.u, step};
  if (Status added = heart_->body.add_forces(motion.u, {}, with, nullptr, &rate); !added) return added;
  if (Status added = heart_->body.add_forces(motion.u, {}, without, nullptr); !added) return added;
  // Pressures within the muscle do no work: the way is that of the displacements.
  Eigen::VectorXd way = motion.u - last_.u;
  way.tail(heart_->body.unknowns() - heart_->body.displacements()).setZero();
  balance_.active -= kMilli * fem::dot(last_active_ + *active, way) / 2;
  balance_.blood += (last_.cavity_kpa + motion.cavity_kpa).dot(motion.cavity_ml - last_.cavity_ml) / 2;
  balance_.viscous += kMilli * fem::dot(with - without, way);
  balance_.dampers += kMilli * form(heart_->dampers, way, last_.velocity + motion.velocity) / 2;
  balance_.stored = *stored - first_stored_;
  balance_.kinetic = kinetic(motion) - first_kinetic_;
  last_ = motion;
  last_active_ = std::move(active).value();
  return std::monostate{};
}

}  // namespace voxtet::beat
