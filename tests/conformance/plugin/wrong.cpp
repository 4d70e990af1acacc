// SPDX-License-Identifier: BSD-3-Clause
// Materials that are wrong, each in one way that the conformance kit must find. Derivatives that come from a
// law (LawPotential) cannot be wrong, so these write them by hand.
#include <cmath>
#include <cstdlib>
#include <string>

#include "seam/physics/potential.hpp"
#include "seam/plugin/plugin.hpp"

namespace {

/// mu/2 (I1 - 3 - 2 ln J) + bulk/2 (J - 1)^2, rightly differentiated.
class Right : public seam::Potential {
 public:
  [[nodiscard]] int arguments() const override { return 3; }
  void evaluate(const double* x, double& value, double* gradient, double* hessian) const override {
    constexpr double mu = 40, bulk = 100;
    const double j = x[2];
    value = 0.5 * mu * (x[0] - 3 - 2 * std::log(j)) + 0.5 * bulk * (j - 1) * (j - 1);
    gradient[0] = 0.5 * mu;
    gradient[1] = 0;
    gradient[2] = -mu / j + bulk * (j - 1);
    for (int i = 0; i < 9; ++i) hessian[i] = 0;
    hessian[8] = mu / (j * j) + bulk;
  }
  void third_derivative(const double* x, double* third) const override {
    for (int i = 0; i < 27; ++i) third[i] = 0;
    third[26] = -80 / (x[2] * x[2] * x[2]);
  }
};

/// Only couplings that differentiate the tangent would notice.
class WrongThird final : public Right {
 public:
  void third_derivative(const double* x, double* third) const override {
    Right::third_derivative(x, third);
    third[26] *= 0.99;
  }
};

/// The tangent lacks a term: Newton still converges, only more slowly.
class WrongHessian final : public Right {
 public:
  void evaluate(const double* x, double& value, double* gradient, double* hessian) const override {
    Right::evaluate(x, value, gradient, hessian);
    hessian[8] *= 0.99;
  }
};

/// Gradient and Hessian fit each other, but not the energy.
class WrongEnergy final : public Right {
 public:
  void evaluate(const double* x, double& value, double* gradient, double* hessian) const override {
    Right::evaluate(x, value, gradient, hessian);
    value += 1 + 0.1 * (x[0] - 3);
  }
};

/// Gets stiffer with every evaluation: a step that failed leaves its mark, a restart begins anew.
class Remembers final : public Right {
 public:
  void evaluate(const double* x, double& value, double* gradient, double* hessian) const override {
    Right::evaluate(x, value, gradient, hessian);
    const double factor = 1 + 1e-9 * static_cast<double>(++count_);
    value *= factor;
    for (int i = 0; i < 3; ++i) gradient[i] *= factor;
    for (int i = 0; i < 9; ++i) hessian[i] *= factor;
  }

 private:
  mutable long count_ = 0;
};

/// Depends on how many ranks there are.
class Counts final : public Right {
 public:
  void evaluate(const double* x, double& value, double* gradient, double* hessian) const override {
    Right::evaluate(x, value, gradient, hessian);
    const double factor = 1 + 1e-5 * ranks();
    value *= factor;
    for (int i = 0; i < 3; ++i) gradient[i] *= factor;
    for (int i = 0; i < 9; ++i) hessian[i] *= factor;
  }

 private:
  static int ranks() {
    const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
    return size ? std::stoi(size) : 1;
  }
};

template <class Material>
void declare(seam::Registry& registry, const std::string& name, seam::Schema schema) {
  registry.add<seam::Potential>(
      "hyperelastic", name, std::move(schema),
      [](const seam::Parameters&, const seam::Registry&) { return std::make_unique<Material>(); });
}

seam::Schema undescribed() {
  seam::Schema s("A key without a meaning, and one whose default is outside its own range.");
  s.number("silent", "").otherwise("1");
  s.number("share", "Without effect").otherwise("2").at_most(1);
  return s;
}

}  // namespace

SEAM_PLUGIN(registry) {
  const seam::Schema described("A material for the tests.");
  declare<Right>(registry, "right", described);
  declare<WrongHessian>(registry, "wrong_hessian", described);
  declare<WrongThird>(registry, "wrong_third", described);
  declare<WrongEnergy>(registry, "wrong_energy", described);
  declare<Remembers>(registry, "remembers", described);
  declare<Counts>(registry, "counts", described);
  declare<Right>(registry, "undescribed", undescribed());
}
