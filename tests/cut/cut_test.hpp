// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <random>
#include <vector>

#include "seam/cut/cut_mesh.hpp"

using Point = std::array<double, 3>;

/// Moves the points of a grid, from the unit square or cube into space.
using Placement = std::function<Point(const Point&)>;

/// n cells per direction of the unit square or cube. Simplices: two triangles or six tetrahedra per cell.
seam::Mesh grid(seam::CellType type, std::array<int, 3> n, const Placement& placement, int order = 1);
Placement unmoved();
/// Rotation about all axes of the dimension, with stretching per axis, then a shift.
Placement rotated(int dimension, double angle, Point stretch, Point shift);

/// A closed polygon, counter-clockwise.
seam::Surface polygon(const std::vector<Point>& points);
seam::Surface circle(Point centre, double radius, int facets, double phase = 0);
seam::Surface star(std::mt19937& random, Point centre, double radius, int facets);
/// Box between two corners; triangulated sphere by refinement of an octahedron; both closed.
seam::Surface box(Point low, Point high);
seam::Surface sphere(Point centre, double radius, int refinements);
seam::Surface moved(seam::Surface surface, const Placement& placement);
seam::Surface reversed(seam::Surface surface);

/// Whether a cell's edges are straight and its faces plane, so that each has one normal.
bool has_flat_sides(const seam::Mesh& mesh, int cell);
/// The vector area of a cut cell's interface and wet faces, m^(d-1): zero for a cell with flat sides.
Point closure(const seam::CutMesh& cut, int cell);
/// The flux of the distance from the cell's middle through its interface and wet faces, m^d: by the
/// divergence theorem its wet volume times the dimension, for a cell with flat sides.
double flux_of_position(const seam::CutMesh& cut, int cell);

/// Properties of a cut that hold whatever the input is. Fails (REQUIRE) when one does not.
/// @return number of cut cells
int check_closure(const seam::CutMesh& cut);
/// The fluid parts of two cuts add up to the cells, where neither has state `cut` included.
void check_complement(const seam::CutMesh& cut, const seam::CutMesh& complement);

/// Volume of the fluid in the whole mesh, and area of the interface.
double total_fluid(const seam::CutMesh& cut);
double total_interface(const seam::CutMesh& cut);
/// Position of reference coordinates in a cell.
Point position(const seam::Mesh& mesh, int cell, const double* reference);
double whole_volume(const seam::Mesh& mesh, int cell);

/// How many times the usual number of random cuts to make: from the environment variable
/// SEAM_CUT_TEST_FACTOR.
int effort();
