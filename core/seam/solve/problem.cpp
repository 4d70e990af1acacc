// SPDX-License-Identifier: BSD-3-Clause
#include "seam/solve/problem.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "seam/assembly/assembler.hpp"
#include "seam/assembly/evaluator.hpp"
#include "seam/assembly/together.hpp"
#include "seam/base/plugin_fault.hpp"
#include "seam/base/stopwatch.hpp"
#include "seam/constraint/joins_fields.hpp"
#include "seam/constraint/watches_cut.hpp"
#include "seam/cut/cut_mesh.hpp"
#include "seam/cut/field_cut.hpp"
#include "seam/field/field.hpp"
#include "seam/field/part_layout.hpp"
#include "seam/field/row_law.hpp"
#include "seam/interface/begins_steps.hpp"
#include "seam/mesh/mesh.hpp"
#include "seam/physics/completes_start.hpp"
#include "seam/solve/body_rates.hpp"
#include "seam/solve/field_builder.hpp"
#include "seam/solve/level.hpp"
#include "seam/solve/multipliers.hpp"

namespace seam {
namespace {

/// Sets of unknowns that a node can have where bodies part the field; further parts share the last one.
constexpr int most_sets = 4;

/// @throws Error where it is no number, with the place in the scene: what is prescribed spoils all that
/// follows
double prescribed_value(const FieldEntry& entry, const PrescribedCondition& condition, const double* x,
                        double time) {
  const int dim = entry.mesh->dimension();
  const double value = condition.value(x, dim, time);
  if (std::isfinite(value)) return value;
  const std::string on =
      condition.boundary.empty() ? "" : fmt::format(" on boundary '{}'", condition.boundary);
  throw Error(condition.where,
              fmt::format("the value given for '{}'{} of field '{}' is {} at ({:.6g}), t = {:.6g}: `{}`",
                          condition.unknown, on, entry.name, value, fmt::join(x, x + dim, ", "), time,
                          condition.value.text()));
}

/// The mesh of a body without deformation: one point at the centre of its shape.
std::shared_ptr<const Mesh> point_mesh(const Mesh& shape, const FieldBuilder& builder) {
  auto data = std::make_shared<MeshData>();
  data->dimension = shape.dimension();
  data->type = CellType::point;
  const Moments m = builder.moments();
  data->coordinates.assign(m.centre, m.centre + shape.dimension());
  data->cells = {0};
  return std::make_shared<Mesh>(shape.name(), data, shape.communicator());
}

/// What is prescribed of a level of a block, and what then has to be its rate; not finite where nothing is
/// known of it.
struct PrescribedLevel {
  const std::vector<double>&value, &rate;
};

/// Rates of a level of the unknowns that have one of this order.
/// @param mean of the step, null where it is not kept
void update_rate(const TimePoint& at, const Block& block, int order, const std::vector<double>& now,
                 const std::vector<double>& old, const std::vector<double>& carried,
                 const PrescribedLevel& prescribed, std::vector<double>& rate, std::vector<double>* mean) {
  const double keep = (1 - at.theta) / at.theta;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (block.time_order[i % block.size] < order) continue;
    rate[i] = at.rate_factor * (now[i] - old[i]) - keep * carried[i];
    // Changing with the value as the scheme's does, it is the prescribed one where the value is: so a linear
    // problem remains one that takes one iteration.
    if (block.prescribed[i] != 0 && std::isfinite(prescribed.value[i]) && std::isfinite(prescribed.rate[i]))
      rate[i] = prescribed.rate[i] + at.rate_factor * (now[i] - prescribed.value[i]);
    if (mean != nullptr) (*mean)[i] = (now[i] - old[i]) / at.step;
  }
}

/// Says where an unknown has to be at a time, and how it moves there.
void prescribe(Block& block, int node, int component, double value, const std::array<double, 2>& rates) {
  const std::size_t i = static_cast<std::size_t>(node) * block.size + component;
  block.prescribed_value[i] = value;
  block.prescribed_rate[i] = rates[0];
  block.prescribed_second_rate[i] = rates[1];
}

/// Prescribed unknowns are where they have to be, and move so.
void start_as_prescribed(Block& block) {
  const auto start = [](double& level, double prescribed) {
    if (std::isfinite(prescribed)) level = prescribed;
  };
  for (std::size_t i = 0; i < block.prescribed.size(); ++i) {
    if (block.prescribed[i] == 0) continue;
    block.now.value[i] = block.prescribed_value[i];
    const int order = block.time_order[i % block.size];
    if (order >= 1) start(block.now.rate[i], block.prescribed_rate[i]);
    if (order >= 2) start(block.now.second_rate[i], block.prescribed_second_rate[i]);
  }
}

/// Gives the unknowns that a coupling's term reads rates of these rates.
void carry_rates_of(const BoundTerm& bound, const std::vector<Field*>& fields) {
  for (const Slot& slot : bound.term->signature(fields.front()->mesh().dimension()).inputs) {
    const auto k = static_cast<std::size_t>(slot.operand);
    if (slot.level == Level::now || slot.level == Level::old || k >= bound.operands.size()) continue;
    const Operand& operand = bound.operands[k];
    const Field::ComponentRange place = fields.at(operand.side)->place(operand.unknown);
    Block& block = fields[operand.side]->blocks()[place.block];
    for (int c = place.offset; c < place.offset + place.components; ++c)
      block.time_order[c] = std::max(block.time_order[c], slot.level == Level::second_rate ? 2 : 1);
  }
}

/// What a physics declares of its unknowns, and those that couplings bring.
/// @throws PluginFault for what cannot be
std::vector<Unknown> declared_unknowns(const FieldEntry& entry, const std::vector<Unknown>& brought,
                                       int dimension) {
  std::vector<Unknown> unknowns = entry.physics->unknowns(dimension);
  unknowns.insert(unknowns.end(), brought.begin(), brought.end());
  std::set<std::string> names;
  for (const Unknown& u : unknowns) {
    std::string wrong;
    if (u.name.empty()) wrong = "has no name";
    if (!names.insert(u.name).second) wrong = "is declared twice";
    if (u.components < 1) wrong = fmt::format("has {} components; at least 1 is needed", u.components);
    if (u.order < 1 || u.order > 2) wrong = fmt::format("is of order {}; there are 1 and 2", u.order);
    if (u.time_order < 0 || u.time_order > 2)
      wrong = fmt::format("has time_order {}; there are 0, 1 and 2", u.time_order);
    if (u.near_nullspace == NearNullspace::rigid_motions && u.components != dimension)
      wrong = fmt::format("has {} components: rigid motions have {}", u.components, dimension);
    if (u.law && u.law->components() != u.components)
      wrong = fmt::format("has {} components; its law is one of {}", u.components, u.law->components());
    if (!(u.scale >= 0)) wrong = fmt::format("has the scale {}; 0 says that it has none", u.scale);
    if (!u.name.empty() && u.name == entry.physics->displacement() && u.role != UnknownRole::motion)
      wrong = "is the displacement of its mesh and does not say so: UnknownRole::motion";
    if (wrong.empty()) continue;
    throw PluginFault(entry.where, fmt::format("field '{}'{}: its unknown '{}' {}", entry.name,
                                               plugin_of(*entry.physics), u.name, wrong));
  }
  return unknowns;
}

/// @throws Error where a body is to start with a rate that what it is tied to, or its given motion, does not
/// leave it
/// @pre it is one point, which this rank owns
void require_kept_rates(const FieldEntry& entry, double time) {
  struct Rate {
    std::string unknown;
    double given, left;
    bool prescribed;
  };
  std::vector<Rate> rates;
  double largest = 0;
  for (const Unknown& unknown : entry.field->unknowns()) {
    const auto [number, offset, components] = entry.field->place(unknown.name);
    const Block& block = entry.field->blocks()[number];
    for (const FieldEntry::Initial& initial : entry.initial) {
      if (!initial.rate || initial.block != number || initial.component < offset ||
          initial.component >= offset + components)
        continue;
      const double given = initial.value(block.space->position(0), entry.mesh->dimension(), time);
      rates.push_back(
          {unknown.name, given, block.now.rate[initial.component], block.prescribed[initial.component] != 0});
      largest = std::max({largest, std::abs(given), std::abs(rates.back().left)});
    }
  }
  constexpr double rounding = 1e-9;
  for (const Rate& rate : rates)
    if (rate.given != 0 && std::abs(rate.given - rate.left) > rounding * largest)  // 0: as it may
      throw Error(entry.where,
                  fmt::format("field '{}' is to start with {:.6g} as a rate of its '{}' (`initial`), and {}",
                              entry.name, rate.given, rate.unknown,
                              rate.prescribed
                                  ? fmt::format("the motion given for it sets off with {:.6g}; leave the "
                                                "initial one out",
                                                rate.left)
                                  : fmt::format("the constraint that ties it leaves {:.6g}; give all of a "
                                                "motion that the constraint lets it make, or only what it "
                                                "is free to do",
                                                rate.left)));
}

/// What a constraint may ask of a problem.
class FieldsForConstraint final : public ConstraintSetup {
 public:
  explicit FieldsForConstraint(Problem& problem) : problem_(problem) {}
  [[nodiscard]] Field& field(const std::string& name) const override { return *problem_.field(name).field; }
  [[nodiscard]] std::vector<int> boundary_nodes(const Field& field, int block,
                                                const std::string& boundary) const override {
    return seam::boundary_nodes(field, block, boundary);
  }
  void close(const Field& field, const std::string& boundary) override {
    for (LevelCondition& level : problem_.field(field.name()).levels)
      std::erase(level.open_boundaries, boundary);
  }

 private:
  Problem& problem_;
};

/// Work on a domain, which may be a plugin's: one that fails on a rank of its own would leave the others
/// waiting.
void attempt(const Communicator& communicator, const IntegrationDomain& domain,
             const std::function<void()>& work) {
  together(communicator, [&] {
    call_plugin(
        {}, [&] { return "the integration over " + domain.description() + plugin_of(domain); }, work);
  });
}

}  // namespace

FieldEntry::FieldEntry() = default;
FieldEntry::~FieldEntry() = default;
FieldEntry::FieldEntry(FieldEntry&&) noexcept = default;
FieldEntry& FieldEntry::operator=(FieldEntry&&) noexcept = default;

Problem::Problem(const Communicator& communicator) : communicator_(communicator) {}
Problem::~Problem() = default;

Field& Problem::add_field(const std::string& name, const std::shared_ptr<const Mesh>& mesh,
                          std::unique_ptr<Physics> physics, const Location& where,
                          const std::vector<Unknown>& brought) {
  FieldEntry& entry = fields_.emplace_back();
  entry.name = name;
  entry.where = where;
  entry.shape = mesh;
  entry.mesh = mesh;
  entry.physics = std::move(physics);
  FieldBuilder builder(entry, domains_);
  std::vector<Unknown> unknowns = declared_unknowns(entry, brought, mesh->dimension());
  if (entry.physics->support() == Support::point) {
    entry.mesh = point_mesh(*mesh, builder);
    // Its mesh has no size: motions are measured by the radius of gyration of its shape.
    const Moments m = builder.moments();
    for (Unknown& unknown : unknowns)
      if (unknown.role == UnknownRole::motion)
        unknown.scale =
            std::max(unknown.scale, std::sqrt((m.second[0][0] + m.second[1][1] + m.second[2][2]) / m.volume));
  }
  entry.field = std::make_unique<Field>(name, *entry.mesh, std::move(unknowns),
                                        entry.physics->separates_parts() ? most_sets : 1);
  state_.include(entry.field->state());
  entry.physics->build(builder);
  builder.finish();
  return *entry.field;
}

void Problem::add_coupling(std::shared_ptr<IntegrationDomain> interface, std::vector<BoundTerm> terms) {
  domains_.emplace_back(std::move(interface), std::move(terms));
}

void Problem::leave_out(const std::string& name, const std::string& term,
                        const std::vector<std::string>& boundaries, const std::string& who) {
  const FieldEntry& entry = field(name);
  const auto found = entry.surfaces.find(term);
  if (found == entry.surfaces.end())
    throw Error(
        fmt::format("{} brings the term '{}' on the surface of field '{}', which has none of this name", who,
                    term, name));
  const auto& [faces, unknowns] = found->second;
  for (const auto& [boundary, tested] : entry.loads) {
    if (!boundaries.empty() && std::ranges::find(boundaries, boundary) == boundaries.end()) continue;
    for (const std::string& unknown : tested)
      if (unknowns.contains(unknown))
        throw Error(fmt::format(
            "{} says what passes through boundary '{}' of field '{}', and so does a condition there on '{}'; "
            "leave the condition out, or name in `boundaries` of the interface those without it",
            who, boundary, name, unknown));
  }
  for (const auto& surface : faces) surface->leave_out(boundaries);
}

void Problem::add_constraint(std::unique_ptr<Constraint> constraint, const Location& where) {
  FieldsForConstraint setup(*this);
  constraint->build(setup);
  if (const auto* joins = dynamic_cast<const JoinsFields*>(constraint.get())) joins_.push_back(joins);
  constraints_.emplace_back(std::move(constraint), where);
}

std::vector<const Constraint*> Problem::constraints() const {
  std::vector<const Constraint*> all;
  for (const auto& [constraint, where] : constraints_) all.push_back(constraint.get());
  return all;
}

void Problem::occupy(FieldEntry& entry, const std::vector<char>& active, const CutMesh* cut) {
  entry.field->occupy(active, cut);
  for (auto& [domain, terms] : domains_)
    attempt(communicator_, *domain, [&, &of = *domain] { of.update(*entry.field); });
  place_levels(fields_, joins_, entry);
}

FieldCut& Problem::cut(FieldEntry& entry) {
  if (!entry.cut) entry.cut = std::make_unique<FieldCut>(*entry.field);
  return *entry.cut;
}

void Problem::finish(double time, bool shape_derivatives) {
  std::vector<Field*> fields;
  for (FieldEntry& entry : fields_) {
    for (const PrescribedCondition& condition : entry.conditions) {
      Block& block = entry.field->blocks()[condition.block];
      for (const int node : condition.nodes)
        block.prescribed[static_cast<std::size_t>(node) * block.size + condition.component] = 1;
    }
    for (Block& block : entry.field->blocks()) block.space->halo().update(block.prescribed, block.size);
    place_levels(fields_, joins_, entry);
    for (const LevelCondition& level : entry.levels)
      if (entry.cut) entry.cut->keep_at(level.open_boundaries);
    fields.push_back(entry.field.get());
  }
  carry_rates();
  update_cuts(time_point(time, 0, 1));
  for (auto& [name, parts] : interfaces_)
    for (InterfacePart& part : parts)
      attempt(communicator_, *part.domain, [&] { part.domain->follow(time); });
  assembler_ = std::make_unique<Assembler>(fields, communicator_);
  using Role = ElementEvaluator::Role;
  for (const auto& [domain, terms] : domains_)
    assembler_->add(domain, terms, shape_derivatives ? Role::integrate : Role::integrate_at_rest);
  if (shape_derivatives) add_swept_volumes();
  update_ties(time_point(time, 0, 1));
  carry_rates_of_bodies(fields_, ties(time_point(time, 0, 1)), communicator_);
  leave_out_multipliers(fields, assembler_->ties(), interfaces_);
  for (const FieldEntry& entry : fields_)
    if (const std::string lost = describe_lost_multipliers(*entry.field, interfaces_); !lost.empty())
      throw Error(entry.where, lost);
  assembler_->rebuild();
}

/// Unknowns have the rates that couplings read, whatever their physics needs: a body without mass has a
/// velocity where it meets another field.
void Problem::carry_rates() {
  std::set<const IntegrationDomain*> couplings;
  for (const auto& [name, parts] : interfaces_)
    for (const InterfacePart& part : parts) couplings.insert(part.domain.get());
  for (const auto& [domain, terms] : domains_) {
    const std::vector<Field*> fields = domain->fields();
    if (fields.front() == fields.back() && !couplings.contains(domain.get())) continue;
    for (const BoundTerm& bound : terms) carry_rates_of(bound, fields);
  }
  for (const InterfaceMeasure& measure : measures_)
    for (const InterfaceMeasure::PartIntegral& share : measure.integrals)
      carry_rates_of(share.quantity, share.domain->fields());
}

/// What others are tied to has the rates that these have. Collective.
void Problem::carry_rates(const std::vector<Ties::Resolved>& ties) {
  std::vector<Block*> blocks;
  std::vector<std::size_t> first{0};
  std::vector<double> order;  // [component of a block]
  for (FieldEntry& entry : fields_)
    for (Block& block : entry.field->blocks()) {
      blocks.push_back(&block);
      order.insert(order.end(), block.time_order.begin(), block.time_order.end());
      first.push_back(order.size());
    }
  const auto order_of = [&](const UnknownPlace& place) -> double& {
    return order[first[place.block] + place.component];
  };
  std::vector<double> takes_momentum(blocks.size(), 0.0);
  for (const Ties::Resolved& tie : ties)
    for (const TiedTo& to : tie.to) {
      if (to.unknown.is_clock()) continue;
      order_of(to.unknown) = std::max(order_of(to.unknown), order_of(tie.unknown));
      if (!tie.changes.empty()) takes_momentum[to.unknown.block] = 1;
    }
  communicator_.max(order);
  communicator_.max(takes_momentum);
  std::size_t number = 0;
  for (FieldEntry& entry : fields_)
    for (std::size_t b = 0; b < entry.field->blocks().size(); ++b)
      if (takes_momentum[number++] > 0) entry.field->keep_momentum();
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    std::size_t c = 0;  // components of an unknown are alike
    for (const int components : blocks[b]->components) {
      const auto from = order.begin() + static_cast<std::ptrdiff_t>(first[b] + c);
      std::fill_n(blocks[b]->time_order.begin() + static_cast<std::ptrdiff_t>(c), components,
                  static_cast<int>(*std::max_element(from, from + components)));
      c += static_cast<std::size_t>(components);
    }
  }
}

/// An interface that moves with a body sweeps over the volume of the field that it bounds.
void Problem::add_swept_volumes() {
  std::set<const IntegrationDomain*> done;
  for (const auto& [surface, couplings] : domains_) {
    if (surface->swept_side() < 0 || !done.insert(surface.get()).second) continue;
    std::vector<BoundTerm> swept;
    for (const auto& [volume, terms] : domains_)
      if (volume->whole_field() == surface->fields()[surface->swept_side()])
        swept.insert(swept.end(), terms.begin(), terms.end());
    assembler_->add(surface, swept, ElementEvaluator::Role::sweep);
  }
}

FieldEntry& Problem::field(const std::string& name) {
  std::vector<std::string> names;
  for (FieldEntry& entry : fields_) {
    if (entry.name == name) return entry;
    names.push_back(entry.name);
  }
  throw Error(fmt::format("there is no field '{}'; the scene has: {}", name, fmt::join(names, ", ")));
}

bool Problem::constrains_rates() const {
  for (const FieldEntry& entry : fields_) {
    const auto has_order = [&](int order) {
      return std::any_of(entry.field->unknowns().begin(), entry.field->unknowns().end(),
                         [&](const Unknown& u) {
                           return u.time_order == order && !u.given && u.role != UnknownRole::derived;
                         });
    };
    if (has_order(0) && has_order(1)) return true;
  }
  return false;
}

bool Problem::needs_fresh_rates(double theta) const {
  if (theta >= 1) return false;
  const bool wanted = std::ranges::any_of(domains_, [](const DomainTerms& domain) {
    return std::ranges::any_of(domain.second, [&](const BoundTerm& bound) {
      return bound.term->signature(domain.first->fields().front()->mesh().dimension()).fresh_rates;
    });
  });
  if (wanted && constrains_rates())
    throw Error(
        "a term needs the rates at the start of each step, as contact with `in_time: hybrid` does, but those "
        "of an incompressible fluid do not follow from the balance at an instant; take `in_time: plain`, or "
        "theta 1");
  return wanted;
}

double Problem::smallest_cut_cell() const {
  double smallest = std::numeric_limits<double>::infinity();
  for (const FieldEntry& entry : fields_)
    for (int c = 0; entry.cut && c < entry.mesh->owned_cells(); ++c)
      smallest = std::min(smallest, entry.mesh->diameter(c));
  return communicator_.min(smallest);
}

bool Problem::has_rates() const {
  for (const FieldEntry& entry : fields_)
    for (const Unknown& unknown : entry.field->unknowns())
      if (unknown.time_order > 0) return true;
  return false;
}

void Problem::initialise(double time, bool impose_prescribed) {
  for (FieldEntry& entry : fields_) {
    const int dim = entry.mesh->dimension();
    for (const auto& initial : entry.initial) {
      Block& block = entry.field->blocks()[initial.block];
      auto& target = initial.rate ? block.now.rate : block.now.value;
      for (int node = 0; node < block.space->nodes(); ++node)
        target[static_cast<std::size_t>(node) * block.size + initial.component] =
            initial.value(block.space->position(node), dim, time);
    }
  }
  set_prescribed(time);
  for (FieldEntry& entry : fields_)
    for (Block& block : entry.field->blocks()) {
      if (impose_prescribed) start_as_prescribed(block);
      // The initial values are those at the node itself, which lies in the wet part of its set 0.
      for (int n = 0; n < block.space->nodes(); ++n) block.known[n] = block.space->set_of(n) == 0 ? 1 : 0;
      entry.field->set_layout(nullptr);
    }
  if (impose_prescribed) settle_start(time);
  state_.advance();
}

/// Lets what follows from initial and prescribed values be so.
void Problem::settle_start(double time) {
  state_.advance();  // a constraint may look at the start of the step
  if (!constraints_.empty()) {
    if (update_ties(time_point(time, 0, 1))) assembler_->rebuild();
    assembler_->settle();
    follow_relations(std::vector<double>(assembler_->ways_of_ties().size(), 0.0), time_point(time, 0, 1));
    assembler_->settle_rates();
    assembler_->settle_given_second_rates();
  }
  together(communicator_, [&] {
    for (const FieldEntry& entry : fields_)
      if (entry.physics->support() == Support::point && entry.field->blocks()[0].space->owned_nodes() > 0)
        require_kept_rates(entry, time);
  });
  for (const FieldEntry& entry : fields_)
    if (const auto* completes = dynamic_cast<const CompletesStart*>(entry.physics.get()))
      completes->complete_start(*entry.field);
}

void Problem::add_initial_rates(const std::vector<double>& increment) {
  const std::vector<double> changes = assembler_->with_tied(increment);
  for (FieldEntry& entry : fields_)
    for (std::size_t b = 0; b < entry.field->blocks().size(); ++b) {
      Block& block = entry.field->blocks()[b];
      for (int node = 0; node < block.space->owned_nodes(); ++node)
        for (int c = 0; c < block.size; ++c) {
          const int row = assembler_->row(*entry.field, static_cast<int>(b), node, c);
          if (row < 0) continue;
          std::vector<double>* levels[3] = {&block.now.value, &block.now.rate, &block.now.second_rate};
          (*levels[block.time_order[c]])[static_cast<std::size_t>(node) * block.size + c] += changes[row];
        }
      for (auto* level : {&block.now.value, &block.now.rate, &block.now.second_rate})
        block.space->halo().update(*level, block.size);
    }
  state_.advance();
}

void Problem::set_given(FieldEntry& entry, double time) {
  for (const FieldEntry::Given& given : entry.given) {
    Block& block = entry.field->blocks()[given.block];
    const int dim = entry.mesh->dimension();
    for (int node = 0; node < block.space->nodes(); ++node) {
      const double* x = block.space->position(node);
      const std::size_t i = static_cast<std::size_t>(node) * block.size + given.component;
      block.prescribed[i] = 1;
      block.now.value[i] = given.value(x, dim, time);
      prescribe(
          block, node, given.component, block.now.value[i],
          block.time_order[given.component] > 0 ? given.value.rates(x, dim, time) : std::array<double, 2>{});
    }
  }
}

void Problem::set_prescribed(double time) {
  for (FieldEntry& entry : fields_) {
    together(communicator_, [&] {
      for (const PrescribedCondition& condition : entry.conditions) {
        Block& block = entry.field->blocks()[condition.block];
        const bool moves = block.time_order[condition.component] > 0;
        for (const int node : condition.nodes) {
          const double* x = block.space->position(node);
          prescribe(
              block, node, condition.component, prescribed_value(entry, condition, x, time),
              moves ? condition.value.rates(x, entry.mesh->dimension(), time) : std::array<double, 2>{});
        }
      }
    });
    set_given(entry, time);
    for (const LevelCondition& level : entry.levels)
      for (const int node : level.nodes) {
        Block& block = entry.field->blocks()[level.block];
        prescribe(block, node, level.component, level.value, {});
      }
    for (Block& block : entry.field->blocks())
      for (auto* level : {&block.prescribed_value, &block.prescribed_rate, &block.prescribed_second_rate})
        block.space->halo().update(*level, block.size);
  }
}

void Problem::begin_step(const TimePoint& at, double from) {
  for (auto& [domain, terms] : domains_)
    if (auto* remembers = dynamic_cast<BeginsSteps*>(domain.get())) remembers->begin_step(from);
  set_prescribed(at.time);
  for (auto& [domain, terms] : domains_) domain->forget_constants(true);
  for (FieldEntry& entry : fields_)
    if (entry.cut) entry.cut->begin_step();
  state_.advance();
  if (at.step > 0 && !constraints_.empty()) {
    TimePoint start = at;
    start.time = from;
    if (update_ties(start)) assembler_->rebuild();
    if (at.inertia_as_momentum)
      assembler_->begin_momentum(start);
    else
      assembler_->forget_momentum();
  }
  for (FieldEntry& entry : fields_)
    for (Block& block : entry.field->blocks()) {
      if (at.step == 0) continue;
      // A body in free motion goes on as it moves; whatever relaxes starts from where it is.
      for (std::size_t i = 0; i < block.now.value.size(); ++i)
        if (block.time_order[i % block.size] == 2 && !block.prescribed[i])
          block.now.value[i] += at.step * block.now.rate[i];
    }
  update_rates(at);
}

void Problem::update_rates(const TimePoint& at, bool relations) {
  if (at.step == 0) return;
  for (FieldEntry& entry : fields_)
    for (Block& block : entry.field->blocks()) {
      const auto& carried = block.old.mean_rate == nullptr ? block.old.rate : *block.old.mean_rate;
      update_rate(at, block, 1, block.now.value, block.old.value, carried,
                  {block.prescribed_value, block.prescribed_rate}, block.now.rate, block.now.mean_rate);
    }
  update_second_rates(at, relations);
}

/// Rates of what is tied follow from those of what it is tied to: differences of its own values would be
/// differences of differences of theirs, and nothing damps an error in these.
void Problem::update_second_rates(const TimePoint& at, bool relations) {
  if (relations && !constraints_.empty() && assembler_) assembler_->settle_rates();
  for (FieldEntry& entry : fields_)
    for (Block& block : entry.field->blocks()) {
      NodalState &now = block.now, &old = block.old;
      const auto& carried = old.mean_second_rate == nullptr ? old.second_rate : *old.mean_second_rate;
      update_rate(at, block, 2, now.rate, old.rate, carried,
                  {block.prescribed_rate, block.prescribed_second_rate}, now.second_rate,
                  now.mean_second_rate);
    }
  if (relations && !constraints_.empty() && assembler_) assembler_->settle_given_second_rates();
}

SpaceChange Problem::update_cuts(const TimePoint& at) {
  const Stopwatch watch;
  SpaceChange change = SpaceChange::none;
  for (FieldEntry& entry : fields_) {
    if (!entry.cut) continue;
    const std::vector<char> before = entry.field->active_cells();
    const std::shared_ptr<const PartLayout> sets = entry.field->layout();
    const bool was_known = !entry.cut->has_new_nodes();
    if (!entry.cut->update(at.time)) continue;
    const bool same = was_known && before == entry.cut->active_cells() &&
                      (entry.field->sets() == 1 || (sets && sets->same_sets(*entry.field->layout())));
    occupy(entry, entry.cut->active_cells(), &entry.cut->mesh());
    if (!same) set_given(entry, at.time);  // nodes of further sets of unknowns may have come
    change = std::max(change, communicator_.any(!same) ? SpaceChange::unknowns : SpaceChange::geometry);
  }
  if (change != SpaceChange::none) {
    for (const auto& [constraint, where] : constraints_)
      if (const auto* watches = dynamic_cast<const WatchesCut*>(constraint.get())) watches->look_at_cut(at);
    update_rates(at);
  }
  cut_seconds_ += watch.seconds();
  return change;
}

std::vector<Ties::Resolved> Problem::ties(const TimePoint& at) {
  return constraints_.empty() ? std::vector<Ties::Resolved>() : ask_constraints(at).close();
}

Ties Problem::ask_constraints(const TimePoint& at) {
  std::vector<Field*> fields;
  for (FieldEntry& entry : fields_) fields.push_back(entry.field.get());
  Ties ties(fields);
  for (const auto& [constraint, where] : constraints_) {
    ties.set_origin(where);
    // One that fails on a rank of its own would leave the others waiting for its ties.
    together(communicator_, [&, &of = *constraint, &place = where] {
      call_plugin(
          place, [&] { return "a constraint" + plugin_of(of); }, [&] { of.tie(ties, at); });
    });
  }
  return ties;
}

/// @return whether others are tied than before: then the system has to be rebuilt
bool Problem::update_ties(const TimePoint& at) {
  if (constraints_.empty()) return false;
  Ties asked = ask_constraints(at);
  const std::vector<Ties::Resolved> tied = asked.close();
  if (!assembler_->tie(tied, asked.axes())) return false;
  carry_rates(tied);
  return true;
}

void Problem::add_increment(const std::vector<double>& increment, double part, const TimePoint& at) {
  std::vector<double> remaining = assembler_->ways_of_ties();
  for (double& way : remaining) way *= 1 - part;
  assembler_->add_increment(increment, part);
  follow_relations(remaining, at);
}

/// Relations are no straight lines: what follows from others is brought to where they say, all but a rest of
/// the way.
void Problem::follow_relations(const std::vector<double>& remaining, const TimePoint& at) {
  constexpr int most = 30;  // each body of a chain may need one more, and quadratic convergence a few
  for (int k = 0; k < most && assembler_->has_turning_ties(); ++k) {
    if (update_ties(at)) {
      unfinished_ = SpaceChange::unknowns;
      return;
    }
    if (!assembler_->follow_ties(remaining)) return;
  }
}

SpaceChange Problem::update_spaces(const TimePoint& at) {
  // An update that is refused on its way leaves some parts updated: the next one begins from scratch.
  SpaceChange change = std::exchange(unfinished_, SpaceChange::unknowns);
  change = std::max(change, update_cuts(at));
  for (auto& [name, parts] : interfaces_)
    for (InterfacePart& part : parts) {
      bool moved = false;
      try {
        attempt(communicator_, *part.domain, [&, &domain = *part.domain] { moved = domain.follow(at.time); });
      } catch (const StepRefused& refused) {
        throw StepRefused(
            fmt::format("{} (interface '{}', {})", refused.what(), name, interface_places_.at(name).text()));
      }
      if (communicator_.any(moved)) change = std::max(change, SpaceChange::geometry);
    }
  for (auto& [domain, terms] : domains_) domain->forget_constants(false);
  for (const SpaceUpdate& update : space_updates_)
    together(communicator_, [&] {
      if (update(at)) change = SpaceChange::unknowns;
    });
  if (update_ties(at)) change = SpaceChange::unknowns;
  if (change != SpaceChange::none) assembler_->rebuild();
  if (!constraints_.empty()) settle_rates(at);
  unfinished_ = SpaceChange::none;
  return change;
}

/// After relations have changed.
void Problem::settle_rates(const TimePoint& at) {
  if (at.initial_rates) {
    assembler_->settle_rates();
    assembler_->settle_second_rates();
  } else if (at.step > 0) {
    update_second_rates(at);
  }
}

bool Problem::update_relations(const TimePoint& at) {
  const bool pending = std::exchange(unfinished_, SpaceChange::none) == SpaceChange::unknowns,
             changed = update_ties(at) || pending;
  if (changed) assembler_->rebuild();
  if (!constraints_.empty()) settle_rates(at);
  return changed;
}

void Problem::keep_mean_rates() {
  for (FieldEntry& entry : fields_) entry.field->keep_mean_rates();
}

void Problem::hold_spaces() {
  for (FieldEntry& entry : fields_)
    if (entry.cut) entry.cut->hold();
}

StateStore::Snapshot Problem::iterate(const TimePoint& at) const {
  const bool reorders =
      std::ranges::any_of(fields_, [](const FieldEntry& entry) { return entry.field->sets() > 1; });
  return state_.snapshot(at.time, reorders);
}

double two_step_theta(double step, double previous) {
  const double ratio = previous > 0 ? step / previous : 0;
  return (1 + ratio) / (1 + 2 * ratio);
}

TimePoint time_point(double time, double step, double theta) {
  TimePoint at;
  at.time = time;
  at.step = step;
  at.theta = theta;
  at.inertia_as_momentum = theta == 0.5;
  if (step > 0) {
    at.rate_factor = 1 / (theta * step);
    at.second_rate_factor = at.rate_factor * at.rate_factor;
  }
  return at;
}

}  // namespace seam
