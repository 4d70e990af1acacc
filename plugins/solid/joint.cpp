// SPDX-License-Identifier: BSD-3-Clause
#include "joint.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

#include "carried.hpp"
#include "joint_conditions.hpp"
#include "seam/assembly/domains.hpp"
#include "seam/assembly/together.hpp"
#include "seam/base/diagnostics.hpp"
#include "seam/constraint/constraint.hpp"
#include "seam/scene/expression.hpp"

namespace seam::solid {
namespace {

/// A node of a body that deforms, and its part of the mean displacement.
struct Weighed {
  UnknownPlace place;  ///< component 0 of the displacement
  double weight = 0;
  Direction displacement{};
};

/// A number for each of the motions that conditions speak of.
using PerMotion = std::array<double, motions>;

template <class Derivatives>
double product(const Derivatives& a, const PerMotion& b) {
  return std::inner_product(b.begin(), b.end(), std::begin(a), 0.0);
}

/// Where all is at an instant, known on all ranks.
struct Present {
  RigidPosition body;
  std::optional<RigidPosition> partner;  ///< another rigid body
  std::vector<Weighed> nodes;            ///< of a boundary
  Direction mean{};                      ///< displacement of the boundary
  Number given{0.0}, given_rate{0.0};    ///< motion, with its rates
  double given_before = 0;               ///< at the start of the step
  bool in_step = false;                  ///< else in a static problem, or before the first step

  [[nodiscard]] Present at_start() const {
    Present start = *this;
    start.body = body.at_start();
    if (partner) start.partner = partner->at_start();
    return start;
  }
  /// How far a body has turned in the step about its axes, or, without a step, since the start.
  [[nodiscard]] Direction turned(const RigidPosition& at) const {
    Direction since{at.rotation};
    for (int k = 0; k < 3 && in_step; ++k) since[k] -= at.old_rotation[k];
    return since;
  }
  /// How unknowns change where things move so: a body's spin is not the rate of its angles.
  [[nodiscard]] PerMotion change(const PerMotion& motion) const {
    PerMotion result = motion;
    const auto turn = [&](const RigidPosition& at, int first) {
      const Mat<3, 3, double> by_turns = at.by_turns();
      for (int i = 0; i < 3; ++i) {
        result[first + i] = 0;
        for (int k = 0; k < 3; ++k) result[first + i] += by_turns(i, k) * motion[first + k];
      }
    };
    turn(body, 3);
    if (partner) turn(*partner, other + 3);
    return result;
  }
  /// Of one of the unknowns of both; of a boundary the mean.
  [[nodiscard]] double value(int k) const {
    if (k >= other && !partner) return mean[k - other];
    const RigidPosition& at = k < other ? body : *partner;
    return k % other < 3 ? at.translation[k % other] : at.rotation[k % other - 3];
  }
};

/// What Gauss-Jordan elimination works on.
std::array<Number, motions>& entries(Condition& row) { return row.motion; }
std::array<double, both + 1>& entries(std::array<double, both + 1>& row) { return row; }

/// Holds a rigid body to another one, to the ground or to a boundary of a body that deforms: as many of its
/// unknowns follow from the rest as the joint takes freedoms.
class Joint final : public Constraint, public HoldsField, public Carried {
 public:
  explicit Joint(const Parameters& p)
      : where_(p.where()),
        kind_(p.text("kind")),
        body_name_(p.text("body")),
        to_name_(p.has("to") ? p.text("to") : ""),
        boundary_(p.has("on") ? p.text("on") : "") {
    to_where_ = p.where("to");
    if (p.has("at")) std::ranges::copy(p.vector("at"), at_.emplace().c.begin());
    if (p.has("axis")) {
      Direction axis{};
      std::ranges::copy(p.vector("axis"), axis.c.begin());
      const double length = std::sqrt(seam::dot(axis, axis));
      if (!(length > 0)) throw Error(p.where("axis"), "the axis of a joint has no direction");
      axis_ = (1 / length) * axis;
    }
    if (p.has("motion")) motion_ = p.expression("motion");
    motion_where_ = p.where("motion");
  }

  void build(ConstraintSetup& setup) override {
    Field& body = setup.field(body_name_);
    dimension_ = body.mesh().dimension();
    body_ = RigidUnknowns(body);
    length_ = body.constant("radius_of_gyration");
    refuse_second(body);
    if (!to_name_.empty() && boundary_.empty()) {
      const Field& to = setup.field(to_name_);
      if (to.mesh().type() != CellType::point)
        throw Error(to_where_, fmt::format("'{}' is no `rigid_body`: a joint to a body that deforms needs "
                                           "`on`, the boundary of it that is to hold '{}'",
                                           to_name_, body_name_));
      to_ = RigidUnknowns(to);
    }
    if (!boundary_.empty()) {
      if (to_name_.empty()) throw Error(where_, "`on` names a boundary of the field `to`, which is missing");
      deforming_ = &setup.field(to_name_);
    }
    require();
    if (deforming_ != nullptr)
      measure_boundary();
    else if (!at_)
      throw Error(where_, "a joint needs the point `at`, where it is in the reference position");
  }

  void tie(Ties& ties, const TimePoint& time) const override {
    Present present{body_.present(ties), std::nullopt, {}, {}, Number(0.0), Number(0.0)};
    present.in_step = time.step > 0;
    if (motion_) set_motion(present, time);
    if (to_) present.partner = to_->present(ties);
    if (deforming_ != nullptr) present.nodes = boundary_nodes(ties);
    for (const Weighed& node : present.nodes) present.mean += node.weight * node.displacement;
    last_.body = present.body;
    together(*communicator_, [&] {
      if (!body_.owned()) return;
      // Which unknowns follow does not change within a step: one that is as good as another would come and
      // go.
      const std::vector<Condition> wanted = conditions(present);
      require_way(present);
      require_side(present, wanted);
      const std::vector<int> followers = choose(conditions(present.at_start()));
      require_hold(present, wanted, followers);
      solve(ties, present, wanted, followers);
    });
  }

  [[nodiscard]] const Field& held() const override { return body_.field(); }

  [[nodiscard]] std::vector<Force> forces() const override {
    return {{"joint_force", dimension_}, {"joint_moment", dimension_ == 3 ? 3 : 1}};
  }

  [[nodiscard]] std::vector<double> force(const std::string& name, const Left& left,
                                          const std::vector<const Constraint*>& all) const override {
    const Forces on = on_body(left, all);
    const Vec<3, double> force{{on[0], on[1], on[2]}};
    if (name == "joint_force") return {force.c.begin(), force.c.begin() + dimension_};
    // About the joint in axes of space, from that about the centre in the body's axes.
    const Mat<3, 3, double> turn = last_.body.turn(Vec<3, double>{last_.body.rotation});
    Direction arm = *at_;
    for (int d = 0; d < dimension_; ++d) arm[d] -= last_.body.centre.position[d];
    const Vec<3, double> moment = turn * Vec<3, double>{{on[3], on[4], on[5]}} - skew(turn * arm) * force;
    return {moment.c.begin() + (dimension_ == 3 ? 0 : 2), moment.c.end()};
  }

  [[nodiscard]] const Field* carrier() const override { return to_ ? &to_->field() : nullptr; }

  [[nodiscard]] Forces handed_on(const Left& left, const std::vector<const Constraint*>& all) const override {
    const std::vector<double> followers = on_followers(left, all);
    Forces forces{};
    for (std::size_t r = 0; r < followers.size(); ++r)
      for (int k = 0; k < other; ++k) forces[k] += last_.handed[r][other + k] * followers[r];
    return summed(forces);
  }

 private:
  /// What was tied last, on the rank that has the body.
  struct Tied {
    RigidPosition body;                            ///< on all ranks
    std::vector<int> follower;                     ///< unknowns of the body that follow
    std::vector<std::array<double, both>> handed;  ///< [follower][what it follows]
  };

  /// The force that holds each unknown that follows: what its equation leaves, and what is handed on to it.
  [[nodiscard]] std::vector<double> on_followers(const Left& left,
                                                 const std::vector<const Constraint*>& all) const {
    const Forces handed = handed_on_to(body_.field(), left, all);
    std::vector<double> forces;
    for (const int k : last_.follower) forces.push_back(body_.left(left, k) + handed[k]);
    return forces;
  }

  /// What the joint exerts on all unknowns of the body. Where it moves as it may, that does no work.
  [[nodiscard]] Forces on_body(const Left& left, const std::vector<const Constraint*>& all) const {
    const std::vector<double> followers = on_followers(left, all);
    Forces forces{};
    for (std::size_t r = 0; r < followers.size(); ++r) {
      forces[last_.follower[r]] += followers[r];
      for (int k = 0; k < other; ++k) forces[k] -= last_.handed[r][k] * followers[r];
    }
    return summed(forces);
  }

  [[nodiscard]] Forces summed(const Forces& own) const {
    std::vector<double> sum(own.begin(), own.end());
    communicator_->sum(sum);
    Forces forces{};
    std::ranges::copy(sum, forces.begin());
    return forces;
  }

  /// @throws Error where it is no number: an increment that is none would pass for one that is met
  [[nodiscard]] double given_motion(double time) const {
    const double value = (*motion_)(at_->c.data(), dimension_, time);
    if (std::isfinite(value)) return value;
    throw Error(motion_where_,
                fmt::format("the `motion` of the joint that holds '{}' is {} at ({:.6g}), t = {:.6g}: `{}`",
                            body_name_, value, fmt::join(at_->c.data(), at_->c.data() + dimension_, ", "),
                            time, motion_->text()));
  }

  /// First and second rate. @throws Error where there is no first one; what has no second one begins anew.
  [[nodiscard]] std::array<double, 2> given_rates(double time) const {
    const auto [rate, second_rate] = motion_->rates(at_->c.data(), dimension_, time);
    if (std::isfinite(rate)) return {rate, std::isfinite(second_rate) ? second_rate : 0};
    throw Error(motion_where_, fmt::format("the `motion` of the joint that holds '{}' has no rate at t = "
                                           "{:.6g}, `{}`: expected one that sets off with a finite velocity",
                                           body_name_, time, motion_->text()));
  }

  /// @throws Error where another joint holds the body
  void refuse_second(Field& body) const {
    constexpr const char* line = "line of its joint";
    if (body.has_constant(line))
      throw Error(
          where_,
          fmt::format("'{}' is held by a second joint; the first one stands at {}. A body has one "
                      "joint; hold the others to it, or by a `spring` on a `link`",
                      body_name_, Location{where_.file, static_cast<int>(body.constant(line)), 0}.text()));
    body.set_constant(line, where_.line);
  }

  /// @throws Error where keys do not go together
  void require() {
    communicator_ = &body_.field().mesh().communicator();
    if (kind_ == "slide" && !axis_) throw Error(where_, "a joint that slides needs the direction `axis`");
    if (axis_ && dimension_ == 2 && kind_ == "hinge")
      throw Error(where_, "in the plane a hinge has no `axis`: what is held turns in the plane");
    if (kind_ == "hinge" && motion_ && dimension_ == 3 && !axis_)
      throw Error(where_, "a given `motion` of a hinge in space needs its `axis`");
    if (kind_ == "weld" && (motion_ || axis_))
      throw Error(where_, "a weld has neither an `axis` nor a `motion`");
    if (deforming_ != nullptr && (kind_ != "hinge" || axis_ || motion_))
      throw Error(
          where_,
          "at a boundary of a body that deforms a joint is a hinge about the boundary's middle, any "
          "way; for other joints fix the boundary to a rigid body of its own (constraint `rigid` with "
          "`on`) and join that one");
    if (deforming_ != nullptr && at_)
      throw Error(where_, "`at` is for joints between points; on a boundary it is the middle");
  }

  /// Parts of nodes in the mean over the boundary, and its middle.
  void measure_boundary() {
    Field& field = *deforming_;
    place_ = field.place("displacement");
    const BoundaryDomain faces(field, boundary_, 2 * std::max(field.order(), field.mesh().order()));
    const Space& space = *field.blocks()[place_.block].space;
    Element element;
    std::vector<double> sums(4, 0.0);
    std::map<int, double> weight;
    for (int e = 0; e < faces.size(); ++e) {
      faces.fill(e, element);
      const ElementSide& side = element.sides[0];
      const ShapeTable& table = *side.table[space.order() - 1];
      for (int q = 0; q < element.points; ++q) {
        sums[3] += element.weight[q];
        for (int d = 0; d < dimension_; ++d)
          sums[d] += element.weight[q] * side.position[static_cast<std::size_t>(q) * dimension_ + d];
        for (int n = 0; n < table.nodes; ++n)
          weight[side.nodes[place_.block][n]] += element.weight[q] * table.value_at(q)[n];
      }
    }
    field.mesh().communicator().sum(sums);
    at_.emplace();
    for (int d = 0; d < dimension_; ++d) (*at_)[d] = sums[d] / sums[3];
    for (const auto& [node, part] : weight) weights_.emplace_back(node, part / sums[3]);
  }

  /// Those of all ranks, each once or, where cells of several have it, in parts.
  [[nodiscard]] std::vector<Weighed> boundary_nodes(const Ties& ties) const {
    const Block& block = deforming_->blocks()[place_.block];
    std::vector<Weighed> own;
    for (const auto& [node, weight] : weights_) {
      if (weight == 0) continue;
      Weighed& entry =
          own.emplace_back(Weighed{ties.place(*deforming_, place_.block, node, place_.offset), weight});
      for (int d = 0; d < dimension_; ++d)
        entry.displacement[d] =
            block.now.value[static_cast<std::size_t>(node) * block.size + place_.offset + d];
    }
    return communicator_->gather_all(own);
  }

  void set_motion(Present& present, const TimePoint& at) const {
    present.given = Number(given_motion(at.time));
    const std::array<double, 2> rates = given_rates(at.time);
    present.given_before = present.in_step ? (*motion_)(at_->c.data(), dimension_, at.time - at.step) : 0;
    present.given.d[the_clock] = rates[0];
    present.given_rate = Number(rates[0]);
    present.given_rate.d[the_clock] = rates[1];
  }

  [[nodiscard]] std::vector<Condition> conditions(const Present& present) const {
    const Partner body(body_, present.body, 0);
    const Partner partner = to_ ? Partner(*to_, *present.partner, other) : Partner();
    Moving way = body.point(*at_) - partner.point(*at_);
    for (int d = 0; d < dimension_ && deforming_ != nullptr; ++d) {
      way.value[d] -= Number(present.mean[d], other + d);
      way.motion[other + d][d] -= Number(1);
    }
    std::vector<Condition> all;
    if (kind_ == "slide") {
      for (const Direction& normal : normals_of(*axis_))
        if (dimension_ == 3 || normal[2] == 0) all.push_back(dot(partner.direction(normal), way));
      if (motion_) {
        all.push_back(dot(partner.direction(*axis_), way));
        all.back().value -= present.given;
        all.back().motion[the_clock] -= present.given_rate;
      }
    } else {
      for (int d = 0; d < dimension_; ++d) {
        Direction e{};
        e[d] = 1;
        all.push_back(dot(fixed(e), way));
      }
    }
    add_rotations(body, partner, present, all);
    return all;
  }

  void add_rotations(const Partner& body, const Partner& partner, const Present& present,
                     std::vector<Condition>& all) const {
    const bool turns = kind_ == "hinge";
    if (dimension_ == 2) {
      if (turns && !motion_) return;
      Condition angle = body.angle();
      const Condition beside = partner.angle();
      angle.value -= beside.value;
      for (int k = 0; k < both; ++k) angle.motion[k] -= beside.motion[k];
      if (turns) {
        angle.value -= present.given;
        angle.motion[the_clock] -= present.given_rate;
      }
      all.push_back(angle);
      return;
    }
    if (!turns) {
      for (int i = 0; i < 3; ++i) {
        Direction one{}, next{};
        one[i] = 1;
        next[(i + 1) % 3] = 1;
        all.push_back(dot(body.direction(one), partner.direction(next)));
      }
      return;
    }
    if (!axis_) return;
    const std::array<Direction, 2> normal = normals_of(*axis_);
    for (const Direction& n : normal) all.push_back(dot(body.direction(*axis_), partner.direction(n)));
    // The first normal turns by the angle: it is normal to where the second one turns.
    if (!motion_) return;
    const Number sine = sin(present.given), cosine = cos(present.given);
    Vec<3, Number> second, first;  // turned
    for (int i = 0; i < 3; ++i) {
      second[i] = cosine * normal[1][i] - sine * normal[0][i];
      first[i] = cosine * normal[0][i] + sine * normal[1][i];
    }
    const Moving turned = body.direction(normal[0]);
    all.push_back(angle(dot(turned, partner.direction(second, -present.given_rate * first)),
                        dot(turned, partner.direction(first, present.given_rate * second))));
    all.back().value += turns_left_out(present, all.back().value.v);
  }

  /// What an angle lacks, of the directions of two bodies: they are the same after whole turns. Unknowns say
  /// how far bodies have turned about the axis in the step (else since the start), nearly.
  [[nodiscard]] double turns_left_out(const Present& present, double angle) const {
    double further = present.given_before - present.given.v;
    for (int k = 0; k < 3; ++k) {
      further += (*axis_)[k] * present.turned(present.body)[k];
      if (present.partner) further -= (*axis_)[k] * present.turned(*present.partner)[k];
    }
    constexpr double turn = 2 * std::numbers::pi;
    return std::isfinite(further) ? turn * std::round((further - angle) / turn) : 0;
  }

  /// In space a body comes to the same place by many turns, and from far iterations find any of them.
  /// @throws StepRefused where it has turned by half a turn more than what holds it and moves it
  void require_way(const Present& present) const {
    if (dimension_ == 2 || !present.in_step || (kind_ == "hinge" && !axis_)) return;
    const auto size = [](const Direction& a) { return std::sqrt(seam::dot(a, a)); };
    const double turn = size(present.turned(present.body)),
                 partner = present.partner ? size(present.turned(*present.partner)) : 0;
    if (turn <= partner + std::abs(present.given.v - present.given_before) + std::numbers::pi) return;
    throw StepRefused(fmt::format(
        "'{}' would turn by {:.3g} rad in a step, at the joint at {}: further than iterations find "
        "back to the right side",
        body_name_, turn, where_.text()));
  }

  /// Directions are normal to each other after half a turn, too.
  /// @throws StepRefused where a body has come to that
  void require_side(const Present& present, const std::vector<Condition>& conditions) const {
    constexpr double met = 1e-6;
    if (dimension_ == 2 || (kind_ == "hinge" && !axis_)) return;
    if (std::ranges::any_of(conditions, [](const Condition& c) { return std::abs(c.value.v) > met; })) return;
    const Partner body(body_, present.body, 0);
    const Partner partner = to_ ? Partner(*to_, *present.partner, other) : Partner();
    for (int i = 0; i < 3; ++i) {
      Direction along{};
      along[i] = 1;
      if (kind_ == "hinge") along = *axis_;
      if (dot(body.direction(along), partner.direction(along)).value.v > 0) continue;
      throw StepRefused(
          fmt::format("the joint at {} would hold '{}' the wrong way round: it has turned too far at once",
                      where_.text(), body_name_));
    }
  }

  /// What follows was chosen at the start of the step: after a quarter of a turn it may say nothing of where
  /// the body is along a slide.
  /// @throws StepRefused where it has come to hardly anything beside what others would say
  void require_hold(const Present& present, std::vector<Condition> rows,
                    const std::vector<int>& chosen) const {
    if (!present.in_step) return;
    constexpr double hardly = 1e-4;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      double most = 0;
      for (int k = 0; k < other; ++k)
        if (body_.free(k)) most = std::max(most, size(rows[r], k));
      if (size(rows[r], chosen[r]) < hardly * most)
        throw StepRefused(fmt::format(
            "'{}' has turned so far in a step that the joint at {} no longer holds what it held at its start",
            body_name_, where_.text()));
      reduce(rows, r, chosen[r]);
    }
  }

  /// Solves the conditions for unknowns of the body, as many as there are: Gauss-Jordan elimination, once of
  /// how values change and once of how virtual motions do.
  void solve(Ties& ties, const Present& present, std::vector<Condition> rows,
             const std::vector<int>& pivot) const {
    std::vector<std::array<double, both + 1>> values(rows.size());  // the last: what is left
    for (std::size_t r = 0; r < rows.size(); ++r) {
      std::ranges::copy(rows[r].value.d, values[r].begin());
      values[r][both] = rows[r].value.v;
    }
    for (std::size_t r = 0; r < rows.size(); ++r) {
      reduce(values, r, pivot[r]);
      reduce(rows, r, pivot[r]);
    }
    const auto stays = [&](int k) { return exists(k) && std::ranges::find(pivot, k) == pivot.end(); };
    // How things move changes with unknowns of rigid bodies alone, and with time.
    std::vector<int> moving;
    for (int k = 0; k < (deforming_ != nullptr ? other : both); ++k)
      if (stays(k)) moving.push_back(k);
    if (motion_) moving.push_back(the_clock);
    std::array<PerMotion, motions> by_value{}, by_motion{};  // [of what changes] how all unknowns do
    for (const int l : moving) {
      by_value[l][l] = by_motion[l][l] = 1;
      for (std::size_t p = 0; p < rows.size(); ++p) {
        if (l < both) by_value[l][pivot[p]] = -values[p][l];
        by_motion[l][pivot[p]] = -rows[p].motion[l].v;
      }
      by_motion[l] = present.change(by_motion[l]);
    }
    last_.follower = pivot;
    last_.handed.assign(rows.size(), {});
    for (std::size_t r = 0; r < rows.size(); ++r) {
      for (int k = 0; k < both; ++k)
        if (stays(k)) last_.handed[r][k] = -rows[r].motion[k].v;
      std::vector<TiedTo> to;
      double constant = present.value(pivot[r]) - values[r][both];
      for (int k = 0; k < both; ++k) {
        if (!stays(k)) continue;
        constant += values[r][k] * present.value(k);
        add(to, present, k, -values[r][k], -rows[r].motion[k].v);
      }
      if (motion_) to.push_back({UnknownPlace::clock(), 0, -rows[r].motion[the_clock].v});
      ties.tie(body_.place(present.body, pivot[r]), std::move(to), constant);
      for (const int k : moving)
        for (const int l : moving) {
          const Number& motion = rows[r].motion[k];
          ties.add_change(place(present, k), place(present, l), -product(motion.d, by_value[l]),
                          -product(motion.d, by_motion[l]));
        }
    }
  }

  /// How much an unknown of the body changes a row: turns by a length of the body as much as translations.
  [[nodiscard]] double size(const Condition& row, int k) const {
    return std::abs(row.motion[k].v) * (k < 3 ? length_ : 1);
  }
  /// An unknown of the body for each condition.
  [[nodiscard]] std::vector<int> choose(std::vector<Condition> rows) const {
    std::vector<double> whole;
    for (const Condition& row : rows) {
      whole.push_back(0);
      for (int k = 0; k < other; ++k) whole.back() = std::max(whole.back(), size(row, k));
    }
    std::vector<int> chosen;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      chosen.push_back(choose(rows[r], whole[r], chosen));
      reduce(rows, r, chosen[r]);
    }
    return chosen;
  }
  /// A translation where one appears.
  /// @param whole size of the row before others were taken out of it
  /// @throws Error where there is none left
  [[nodiscard]] int choose(const Condition& row, double whole, const std::vector<int>& taken) const {
    constexpr double nothing = 1e-6;
    int best = -1;
    for (int k = 0; k < other; ++k) {
      if (k == 3 && best >= 0) break;
      if (!body_.free(k) || std::ranges::find(taken, k) != taken.end()) continue;
      if (size(row, k) > nothing * whole && (best < 0 || size(row, k) > size(row, best))) best = k;
    }
    if (best >= 0) return best;
    throw Error(where_, "this joint cannot hold '" + body_name_ +
                            "': what it would take is given already by the body's own `translation` or "
                            "`rotation`");
  }

  /// Lets one row alone have an unknown, with the factor 1.
  template <class Rows>
  static void reduce(Rows& rows, std::size_t r, int pivot) {
    auto& own = entries(rows[r]);
    const auto factor = own[pivot];
    for (auto& entry : own) entry = entry / factor;
    for (std::size_t s = 0; s < rows.size(); ++s) {
      if (s == r) continue;
      auto& row = entries(rows[s]);
      const auto part = row[pivot];
      for (std::size_t k = 0; k < row.size(); ++k) row[k] = row[k] - part * own[k];
    }
  }

  [[nodiscard]] bool exists(int k) const {
    if (k < other) return body_.exists(k);
    if (to_) return to_->exists(k - other);
    return deforming_ != nullptr && k - other < dimension_;
  }
  [[nodiscard]] UnknownPlace place(const Present& present, int k) const {
    if (k == the_clock) return UnknownPlace::clock();
    return k < other ? body_.place(present.body, k) : to_->place(*present.partner, k - other);
  }
  void add(std::vector<TiedTo>& to, const Present& present, int k, double coefficient, double handed) const {
    // Zeros of a moment would come and go with the pattern; what a node is to the mean stays.
    if (k < other || to_) {
      to.push_back({place(present, k), coefficient, handed});
      return;
    }
    if (coefficient == 0 && handed == 0) return;
    for (const Weighed& node : present.nodes) {
      UnknownPlace component = node.place;
      component.component += k - other;
      to.push_back({component, node.weight * coefficient, node.weight * handed});
    }
  }

  Location where_, to_where_, motion_where_;
  std::string kind_, body_name_, to_name_, boundary_;
  std::optional<Direction> at_, axis_;
  std::optional<Expression> motion_;  ///< rad or m
  int dimension_ = 2;
  double length_ = 0;  ///< of the body that is held, m
  const Communicator* communicator_ = nullptr;
  RigidUnknowns body_;
  std::optional<RigidUnknowns> to_;              ///< another rigid body
  Field* deforming_ = nullptr;                   ///< what the boundary belongs to
  Field::ComponentRange place_{};                ///< of its displacement
  std::vector<std::pair<int, double>> weights_;  ///< of local nodes in the mean over the boundary
  mutable Tied last_;
};

}  // namespace

void declare_joint(Registry& registry) {
  Schema schema("Holds a rigid body to another one, to the ground or to a boundary of a body that deforms.");
  schema.choice("kind",
                "`hinge`: a point of both stays one, in space about an axis or, without, any way; `slide`: "
                "along a direction of what it is held to, without turning; `weld`: not at all",
                {"hinge", "slide", "weld"});
  schema.reference("body", "The `rigid_body` that is held: by one joint, others may be held to it", "field");
  schema
      .reference("to", "What holds it: a `rigid_body` or, with `on`, a body that deforms; default the ground",
                 "field")
      .optional();
  schema
      .text("on",
            "Boundary of a body that deforms: a hinge about its middle, which moves with the mean of "
            "its points")
      .optional();
  schema.vector("at", "A point of both, in the reference position; needed unless `on` is given")
      .unit("m")
      .optional();
  schema.vector("axis", "Of a hinge in space, or along which to slide, in the reference position").optional();
  schema.expression("motion", "Given angle, rad, or way, m; default free").optional();
  registry.add<Constraint>("constraint", "joint", schema,
                           [](const Parameters& p, const Registry&) { return std::make_unique<Joint>(p); });
}

}  // namespace seam::solid
