// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "seam/interface/interface.hpp"
#include "seam/surface/moving_body.hpp"

namespace seam {

/// The surface of a deforming body where it may come to touch another body, or itself: of each of its points
/// the one opposite to it at the end of the current normal, and the gap between them (thesis (6.2)). Side 0
/// is the body, side 1 the other one. Points without an opposite one are no part of it.
///
/// One such interface looks from one body at the other; two of them look both ways.
class ContactInterface final : public Interface {
 public:
  explicit ContactInterface(const Parameters& parameters) : parameters_(parameters) {}
  static Schema schema();
  [[nodiscard]] std::vector<std::string> fields() const override {
    return {parameters_.text("from"), parameters_.text("to")};
  }
  [[nodiscard]] std::vector<std::string> boundaries(int side) const override {
    return parameters_.names(side == 0 ? "boundaries" : "opposite");
  }
  [[nodiscard]] std::vector<InterfacePart> build(InterfaceSetup& setup) const override;

 private:
  Parameters parameters_;
};

/// The same where the other body is rigid, of given shape and motion: there is no side 1.
class ObstacleInterface final : public Interface {
 public:
  ObstacleInterface(const Parameters& parameters, const Registry& types)
      : parameters_(parameters), obstacle_(parameters, types) {}
  static Schema schema();
  [[nodiscard]] std::vector<std::string> fields() const override { return {parameters_.text("from")}; }
  [[nodiscard]] std::vector<std::string> boundaries(int) const override {
    return parameters_.names("boundaries");
  }
  [[nodiscard]] std::vector<InterfacePart> build(InterfaceSetup& setup) const override;

 private:
  Parameters parameters_;
  MovingBody obstacle_;
};

/// Two boundaries that lie on each other in the reference configuration, whose faces need not be alike: of
/// each point of side 0 that opposite to it on side 1, for good. Points without an opposite one are no part
/// of it.
class NonMatchingInterface final : public Interface {
 public:
  explicit NonMatchingInterface(const Parameters& parameters);
  static Schema schema();
  [[nodiscard]] std::vector<std::string> fields() const override { return parameters_.names("fields"); }
  [[nodiscard]] std::vector<std::string> boundaries(int side) const override {
    return {parameters_.names("boundaries")[side]};
  }
  [[nodiscard]] std::vector<InterfacePart> build(InterfaceSetup& setup) const override;

 private:
  Parameters parameters_;
};

/// A deforming body's surface in a field out of whose mesh it is cut, and what lies opposite to it there.
/// Side 0 is that field, side 1 the body, side 2 the other one. It has five parts, see EmbeddedSurface:
/// `free` with sides 0 and 1, `near` with all of them and a gap, `closed`, where side 0 is the nearest wet
/// point's trace and sides 3 and 4 are the two bodies there, `shut` with sides 1 and 2, and `covered` with
/// side 1 alone. In the last two side 0 is the body, too.
class EmbeddedContactInterface final : public Interface {
 public:
  explicit EmbeddedContactInterface(const Parameters& parameters) : parameters_(parameters) {}
  static Schema schema();
  [[nodiscard]] std::vector<std::string> fields() const override {
    return {parameters_.text("field"), parameters_.text("body"), parameters_.text("to")};
  }
  [[nodiscard]] std::vector<std::string> boundaries(int side) const override {
    return side == 1 ? parameters_.names("boundaries") : std::vector<std::string>{};
  }
  [[nodiscard]] std::vector<InterfacePart> build(InterfaceSetup& setup) const override;

 private:
  Parameters parameters_;
};

/// Registers "contact", "obstacle", "non_matching" and "embedded_contact".
void register_contact(Registry& registry);

}  // namespace seam
