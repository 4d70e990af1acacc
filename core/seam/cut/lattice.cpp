// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/lattice.hpp"

#include <algorithm>
#include <cmath>

namespace seam::cutting {
namespace {

__extension__ using Wide = __int128;

int sign(Wide value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

LatticePoint difference(const LatticePoint& a, const LatticePoint& b) {
  return {{a.x[0] - b.x[0], a.x[1] - b.x[1], a.x[2] - b.x[2]}};
}

std::array<Wide, 3> product(const LatticePoint& a, const LatticePoint& b) {
  const auto minor = [&](int i, int j) {
    return static_cast<Wide>(a.x[i]) * b.x[j] - static_cast<Wide>(a.x[j]) * b.x[i];
  };
  return {minor(1, 2), minor(2, 0), minor(0, 1)};
}

/// Sign of the triple product. Its 160 bits are summed in two parts of a higher and a lower weight.
int triple(const std::array<Wide, 3>& normal, const LatticePoint& d) {
  constexpr int bits = 54;
  constexpr Wide mask = (static_cast<Wide>(1) << bits) - 1;
  Wide high = 0, low = 0;
  for (int i = 0; i < 3; ++i) {
    high += (normal[i] >> bits) * d.x[i];
    low += (normal[i] & mask) * d.x[i];
  }
  high += low >> bits;
  low &= mask;
  return high != 0 ? sign(high) : sign(low);
}

/// Sign of normal . (e, e^2, e^3).
int along_translation(const std::array<Wide, 3>& normal) {
  for (const Wide component : normal)
    if (component != 0) return sign(component);
  return 0;
}

Wide area(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
  return static_cast<Wide>(b.x[0] - a.x[0]) * (c.x[1] - a.x[1]) -
         static_cast<Wide>(b.x[1] - a.x[1]) * (c.x[0] - a.x[0]);
}

/// Sign of the area of the direction ab with (e, e^2).
int turn_to_translation(const LatticePoint& a, const LatticePoint& b) {
  return a.x[1] != b.x[1] ? (a.x[1] > b.x[1] ? 1 : -1) : sign(b.x[0] - a.x[0]);
}

}  // namespace

Lattice::Lattice(const Vector& low, const Vector& high) {
  double size = 0;
  for (int i = 0; i < 3; ++i) size = std::max(size, high[i] - low[i]);
  spacing_ = std::ldexp(1.0, std::ilogb(size > 0 ? size : 1.0) - 49);
  for (int i = 0; i < 3; ++i) origin_[i] = std::floor(low[i] / spacing_) * spacing_;
}

LatticePoint Lattice::round(const Vector& position) const {
  LatticePoint point;
  for (int i = 0; i < 3; ++i) point.x[i] = 2 * std::llround((position[i] - origin_[i]) / (2 * spacing_));
  return point;
}

Vector Lattice::position(const LatticePoint& point) const {
  Vector position;
  for (int i = 0; i < 3; ++i) position[i] = origin_[i] + static_cast<double>(point.x[i]) * spacing_;
  return position;
}

int side_of_mesh_edge(const LatticePoint& a, const LatticePoint& b, const LatticePoint& p) {
  const int s = sign(area(a, b, p));
  return s != 0 ? s : turn_to_translation(a, b);
}

int side_of_facet(const LatticePoint& p, const LatticePoint& q, const LatticePoint& a) {
  const int s = sign(area(p, q, a));
  return s != 0 ? s : -turn_to_translation(p, q);
}

int side_of_mesh_face(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                      const LatticePoint& p) {
  const auto normal = product(difference(b, a), difference(c, a));
  const int s = triple(normal, difference(p, a));
  return s != 0 ? s : along_translation(normal);
}

int side_of_facet(const LatticePoint& p, const LatticePoint& q, const LatticePoint& r,
                  const LatticePoint& a) {
  const auto normal = product(difference(q, p), difference(r, p));
  const int s = triple(normal, difference(a, p));
  return s != 0 ? s : -along_translation(normal);
}

int side_of_edges(const LatticePoint& a, const LatticePoint& b, const LatticePoint& p,
                  const LatticePoint& q) {
  const LatticePoint edge = difference(b, a);
  const int s = triple(product(edge, difference(p, a)), difference(q, a));
  return s != 0 ? s : along_translation(product(edge, difference(p, q)));
}

bool collinear(const LatticePoint& p, const LatticePoint& q, const LatticePoint& r) {
  return along_translation(product(difference(q, p), difference(r, p))) == 0;
}

double size(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
  return static_cast<double>(area(a, b, c));
}

double size(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d) {
  const auto normal = product(difference(b, a), difference(c, a));
  const LatticePoint e = difference(d, a);
  long double sum = 0;
  for (int i = 0; i < 3; ++i) sum += static_cast<long double>(normal[i]) * static_cast<long double>(e.x[i]);
  return static_cast<double>(sum);
}

int orientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
  return sign(area(a, b, c));
}

int orientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d) {
  return triple(product(difference(b, a), difference(c, a)), difference(d, a));
}

}  // namespace seam::cutting
