// SPDX-License-Identifier: BSD-3-Clause
#include "seam/contact/contact_domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace seam {

using namespace cutting;

namespace {

std::array<Vector, 3> vertices(const Surface& surface, int facet) {
  const int dim = surface.dimension;
  std::array<Vector, 3> result{};
  for (int k = 0; k < dim; ++k) {
    const int p = surface.facets[static_cast<std::size_t>(facet) * dim + k];
    std::copy_n(&surface.points[static_cast<std::size_t>(p) * dim], dim, result[k].begin());
  }
  return result;
}

/// The facets behind which cells of this rank lie.
std::vector<int> owned_facets(const BodySurface& surface) {
  const Mesh& mesh = surface.body().mesh();
  std::vector<int> result;
  for (int f = 0; f < surface.facet_count(); ++f)
    if (mesh.owner_of_global_cell()[surface.cell(surface.group(f)).global_cell] == mesh.communicator().rank())
      result.push_back(f);
  return result;
}

void append(const std::vector<double>& from, std::vector<double>& to) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

ContactDomain::ContactDomain(std::shared_ptr<const BodySurface> own, std::shared_ptr<const BodySurface> other,
                             MovingSurface obstacle, ContactWindow window, int degree)
    : own_(std::move(own)),
      other_(std::move(other)),
      obstacle_(std::move(obstacle)),
      window_(window),
      rule_(
          &quadrature(own_->body().mesh().dimension() == 2 ? CellType::segment : CellType::triangle, degree)),
      facets_(owned_facets(*own_)),
      movers_{{0, own_->displacement()}},
      of_side_{{own_->body(), own_->place()}} {
  if (!other_) return;
  movers_.push_back({1, other_->displacement()});
  of_side_.emplace_back(other_->body(), other_->place());
}

std::vector<Field*> ContactDomain::fields() const {
  if (!other_) return {&own_->body()};
  return {&own_->body(), &other_->body()};
}

bool ContactDomain::follow(double time) {
  std::vector<Pairing> before;
  for (const Piece& piece : elements_) before.push_back({piece.facet, piece.opposite_group});
  elements_.clear();
  const Surface surface = own_->now();
  const FacetSearch search(!other_ ? obstacle_(time) : (other_ == own_ ? surface : other_->now()));
  for (const int facet : facets_) add_facet(surface, facet, search);
  return !std::ranges::equal(before, elements_, [](const Pairing& pairing, const Piece& piece) {
    return pairing == Pairing{piece.facet, piece.opposite_group};
  });
}

/// In contact with itself a thin part of a body must not take its own back for a surface that it has passed.
bool ContactDomain::is_own_neighbourhood(int facet, int other_facet) const {
  if (own_->group(facet) == own_->group(other_facet)) return true;
  const std::vector<int>& first = own_->cell(own_->group(facet)).nodes[own_->place().block];
  const std::vector<int>& second = own_->cell(own_->group(other_facet)).nodes[own_->place().block];
  return std::ranges::find_first_of(first, second) != first.end();
}

void ContactDomain::add_facet(const Surface& surface, int facet, const FacetSearch& search) {
  const int dim = surface.dimension, moves = static_cast<int>(movers_.size()) * dim * dim;
  FacetPair pair;
  pair.dimension = dim;
  pair.own = vertices(surface, facet);
  Vector normal = facet_normal(dim, pair.own);
  const double area = std::sqrt(dot(normal, normal));
  normal = (1 / area) * normal;
  const auto exclude = [&](int other_facet, double gap) {
    return other_ == own_ && gap <= 0 && is_own_neighbourhood(facet, other_facet);
  };
  for (const Stretch& stretch : stretches(pair.own, normal, search))
    for (int q = 0; q < rule_->count(); ++q) {
      std::copy_n(&rule_->points[static_cast<std::size_t>(q) * (dim - 1)], dim - 1, pair.on_own.begin());
      if (dim == 2) pair.on_own[0] = stretch.from.share + pair.on_own[0] * stretch.length();
      Vector x = pair.own[0];
      for (int k = 1; k < dim; ++k) x = x + pair.on_own[k - 1] * (pair.own[k] - pair.own[0]);
      const auto hit = search.find(x.data(), normal.data(), window_.depth, window_.reach, exclude);
      if (!hit) continue;
      pair.opposite = vertices(search.surface(), hit->facet);
      pair.on_opposite = hit->on_facet;
      pair.gap = hit->gap;
      std::vector<double> slide, growth;
      if (dim == 2)
        stretch_motion(pair, stretch, &search.surface().facets[2 * hit->facet], moves, slide, growth);
      PairMotion change = pair_motion(pair, moves, slide);
      for (std::size_t m = 0; m < growth.size(); ++m) change.relative_weight[m] += growth[m];
      slide.resize(static_cast<std::size_t>(dim - 1) * moves, 0.0);

      Piece& to = piece(facet, other_ ? other_->group(hit->facet) : -1);
      to.own.weight.push_back(area * stretch.length() * rule_->weights[q]);
      own_->to_cell(facet, pair.on_own.data(), to.own.reference);
      to.normal.insert(to.normal.end(), normal.begin(), normal.begin() + dim);
      to.gap.push_back(hit->gap);
      PointMotion& motion = to.motion;
      motion.node.insert(motion.node.end(), own_->places(facet), own_->places(facet) + dim);
      motion.position.resize(motion.position.size() + static_cast<std::size_t>(dim) * moves, 0.0);
      own_->motion_to_cell(facet, slide.data(), moves, motion.reference[0]);
      append(change.normal, motion.normal);
      append(change.relative_weight, motion.relative_weight);
      append(change.gap, motion.gap);
      if (!other_) continue;
      other_->to_cell(hit->facet, hit->on_facet.data(), to.opposite.reference);
      to.opposite.weight = to.own.weight;
      motion.node.insert(motion.node.end(), other_->places(hit->facet), other_->places(hit->facet) + dim);
      other_->motion_to_cell(hit->facet, change.on_opposite.data(), moves, motion.reference[1]);
    }
}

/// In the plane: the parts of a facet between which the facet opposite changes, so that integrals are exact.
std::vector<ContactDomain::Stretch> ContactDomain::stretches(const std::array<Vector, 3>& own,
                                                             const Vector& normal,
                                                             const FacetSearch& search) const {
  if (own_->body().mesh().dimension() != 2) return {{{0, -1}, {1, -1}}};
  const Vector along = own[1] - own[0];
  Vector low = own[0], high = own[0];
  for (const Vector& end : {own[0], own[1]})
    for (const double way : {-window_.depth, window_.reach})
      for (int d = 0; d < 2; ++d) {
        low[d] = std::min(low[d], end[d] + way * normal[d]);
        high[d] = std::max(high[d], end[d] + way * normal[d]);
      }
  std::vector<int> near;
  search.find_near(low.data(), high.data(), normal.data(), near);
  std::vector<Break> breaks{{0, -1}, {1, -1}};
  for (const int facet : near)
    for (int k = 0; k < 2; ++k) {
      const int vertex = search.surface().facets[static_cast<std::size_t>(facet) * 2 + k];
      const Vector r = vertices(search.surface(), facet)[k] - own[0];
      const double share = dot(r, along) / dot(along, along), height = dot(r, normal);
      constexpr double least = 1e-9;
      if (share > least && share < 1 - least && height >= -window_.depth && height <= window_.reach)
        breaks.push_back({share, vertex});
    }
  std::ranges::sort(breaks, [](const Break& a, const Break& b) {
    return a.share != b.share ? a.share < b.share : a.vertex < b.vertex;
  });
  std::vector<Stretch> result;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
    if (breaks[k + 1].share > breaks[k].share) result.push_back({breaks[k], breaks[k + 1]});
  return result;
}

/// How a point slides that keeps its part of a stretch, and how the stretch's share of the facet grows, where
/// its ends follow vertices of the facet opposite. @param vertex of that facet's ends
void ContactDomain::stretch_motion(const FacetPair& pair, const Stretch& stretch, const int* vertex,
                                   int moves, std::vector<double>& slide, std::vector<double>& growth) {
  const Vector along = pair.own[1] - pair.own[0];
  const double square = dot(along, along);
  // share = (v - a).along/square
  const auto change = [&](const Break& end, int m) {
    if (end.vertex < 0 || (end.vertex != vertex[0] && end.vertex != vertex[1])) return 0.0;
    const int facet = m / 4, k = m % 4 / 2, c = m % 2;
    if (facet == 1) return end.vertex == vertex[k] ? along[c] / square : 0.0;
    const Vector v = pair.opposite[end.vertex == vertex[0] ? 0 : 1] - pair.own[0];
    const double turn = (v[c] - 2 * end.share * along[c]) / square;
    return k == 1 ? turn : -turn - along[c] / square;
  };
  const double place = (pair.on_own[0] - stretch.from.share) / stretch.length();
  for (int m = 0; m < moves; ++m) {
    const double from = change(stretch.from, m), to = change(stretch.to, m);
    slide.push_back((1 - place) * from + place * to);
    growth.push_back((to - from) / stretch.length());
  }
}

/// The element of a facet and a cell opposite to it, among those of the facet under work.
ContactDomain::Piece& ContactDomain::piece(int facet, int opposite_group) {
  for (auto found = elements_.rbegin(); found != elements_.rend() && found->facet == facet; ++found)
    if (found->opposite_group == opposite_group) return *found;
  Piece& added = elements_.emplace_back();
  added.facet = facet;
  added.group = own_->group(facet);
  added.opposite_group = opposite_group;
  return added;
}

void ContactDomain::fill(int index, Element& element) const {
  const Piece& piece = elements_[index];
  element.dimension = own_->body().mesh().dimension();
  element.points = static_cast<int>(piece.own.weight.size());
  element.sides.resize(other_ ? 2 : 1);
  own_->cell(piece.group).attach(element.sides[0], own_->body());
  piece.own.attach(element.sides[0], true);
  element.sides[0].map_geometry();
  if (other_) {
    other_->cell(piece.opposite_group).attach(element.sides[1], other_->body());
    piece.opposite.attach(element.sides[1], true);
    element.sides[1].map_geometry();
  }
  element.weight = piece.own.weight;
  element.normal = piece.normal;
  element.gap = piece.gap;
  element.set_sizes(element.sides[0].diameter, element.sides[0].diameter);
  element.motion = &piece.motion;
  element.constants.resize(constants_.size());
  for (std::size_t k = 0; k < constants_.size(); ++k) {
    const int side = constants_[k].side;
    const BodySurface& surface = side == 0 ? *own_ : *other_;
    const int group = side == 0 ? piece.group : piece.opposite_group;
    element.constants[k].assign(
        element.points,
        of_side_[side].value(constants_[k].number, group, surface.cell(group), surface.faces(group)));
  }
}

const int* ContactDomain::nodes(int index, int side, int block) const {
  const Piece& piece = elements_[index];
  return side == 0 ? own_->cell(piece.group).nodes[block].data()
                   : other_->cell(piece.opposite_group).nodes[block].data();
}

int ContactDomain::add_constant(int side, std::shared_ptr<const CellConstant> constant) {
  constants_.push_back({side, of_side_.at(side).add(std::move(constant))});
  return static_cast<int>(constants_.size()) - 1;
}

void ContactDomain::forget_constants(bool new_step) {
  for (CellConstants& constants : of_side_)
    constants.forget(new_step ? CellConstant::Refresh::step : CellConstant::Refresh::iteration);
}

std::string ContactDomain::description() const {
  return fmt::format("the surface of '{}' opposite to {}", own_->body().name(),
                     !other_ ? "an obstacle" : fmt::format("'{}'", other_->body().name()));
}

}  // namespace seam
