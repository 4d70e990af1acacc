// Two blocks with wavy inner lines, one at each wall of a channel, or the disc that is pushed between them.
// The blocks reach a little beyond the walls, x = -1 and 1.
DefineConstant[
  blocks = 1,     // 0: the disc
  h = 0.055,      // size of the cells
  radius = 0.18,  // of every bump and pocket
  axis = 0.37,    // distance of their centres from the channel's axis
  top = 4.33,     // of the right block
  lower = 0.05    // of the left block than the right one
];
Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 1;
Mesh.CharacteristicLengthMin = h;
Mesh.CharacteristicLengthMax = h;
Mesh.CharacteristicLengthFromPoints = 0;
If (blocks)
  For side In {0:1}
    sign = 1 - 2*side;
    y = top - side*lower;
    p = newp;
    Point(p) = {sign*1.05, y, 0};
    Point(p + 1) = {sign*axis, y, 0};
    l = newl;
    Line(l) = {p, p + 1};
    curves[] = {l};
    from = p + 1;
    For k In {0:4}
      c = newp;
      Point(c) = {sign*axis, y - (2*k + 1)*radius, 0};
      bend = (k % 2 == 0) ? -radius : radius;
      Point(c + 1) = {sign*(axis + bend), y - (2*k + 1)*radius, 0};
      Point(c + 2) = {sign*axis, y - (2*k + 2)*radius, 0};
      l = newl;
      Circle(l) = {from, c, c + 1};
      Circle(l + 1) = {c + 1, c, c + 2};
      curves[] += {l, l + 1};
      from = c + 2;
    EndFor
    q = newp;
    Point(q) = {sign*1.05, y - 10*radius, 0};
    l = newl;
    Line(l) = {from, q};
    Line(l + 1) = {q, p};
    curves[] += {l, l + 1};
    Curve Loop(1 + side) = curves[];
    Plane Surface(1 + side) = {1 + side};
    held[side] = l + 1;
  EndFor
  ReverseMesh Surface{2};
  Physical Curve("held") = held[];
  Physical Surface("blocks") = {1, 2};
Else
  Point(1) = {0, 4.6625, 0};
  For k In {0:3}
    Point(2 + k) = {0.25*Cos(k*Pi/2), 4.6625 + 0.25*Sin(k*Pi/2), 0};
  EndFor
  For k In {0:3}
    Circle(1 + k) = {2 + k, 1, 2 + (k + 1)%4};
  EndFor
  Curve Loop(1) = {1:4};
  Plane Surface(1) = {1};
  Physical Surface("disc") = {1};
EndIf
Recombine Surface{:};
