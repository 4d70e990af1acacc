// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace seam {

class Field;
struct ElementSide;

/// Lets nodes of a face hand on the functions of those beside them that have no unknowns of a surface
/// (Block::left_out): each of these deals its function out alike among the others of the face, so that
/// together they still make up a constant. Nothing is tabulated anew where no node is left out.
/// @param side with its tables, at points of that face
void hand_on_functions(const Field& field, int face, ElementSide& side);

}  // namespace seam
