// The parts of an elastic pump that deform: two walls of a chamber, arcs about (0.75, -+0.508), and two pairs of flaps
// whose roots lie in a rigid frame beyond y = -+duct.
DefineConstant[
  h = 0.0125,       // size of the cells
  thick = 0.115,    // of a chamber's wall
  flap = 0.028,     // thickness of a flap
  clear = 0.0128,   // distance of two tips
  duct = 0.065,     // half of the height of the channels
  cell = 0.68,      // edges of the cells over h, away from transfinite curves
  root = 0.03       // length of a flap inside the frame
];
Mesh.MeshSizeMin = cell*h;
Mesh.MeshSizeMax = cell*h;
inner = 0.678;
outer = inner + thick;
half = Asin(0.3/inner);
For k In {0:1}
  s = 1 - 2*k;
  y = -0.508*s;
  c = newp;
  Point(c) = {0.75, y, 0};
  Point(c + 1) = {0.75 - inner*Sin(half), y + s*inner*Cos(half), 0};
  Point(c + 2) = {0.75 + inner*Sin(half), y + s*inner*Cos(half), 0};
  Point(c + 3) = {0.75 + outer*Sin(half), y + s*outer*Cos(half), 0};
  Point(c + 4) = {0.75 - outer*Sin(half), y + s*outer*Cos(half), 0};
  l = newl;
  Circle(l) = {c + 1, c, c + 2};
  Line(l + 1) = {c + 2, c + 3};
  Circle(l + 2) = {c + 3, c, c + 4};
  Line(l + 3) = {c + 4, c + 1};
  Transfinite Curve{l, l + 2} = Round(0.62/h) + 1;
  Transfinite Curve{l + 1, l + 3} = Round(thick/h) + 1;
  held[] += {l + 1, l + 3};
  pushed[] += {l + 2};
  Curve Loop(1 + k) = {l:l + 3};
  Plane Surface(1 + k) = {1 + k};
  Transfinite Surface{1 + k};
EndFor
// Flaps: the middle line runs from inside the frame to the centre of a round tip.
For k In {0:3}
  s = (k % 2 == 0) ? 1 : -1;
  x = (k < 2) ? 0.38 : 1.27;
  y = clear/2 + flap/2;
  dx = -0.1*(duct - y)/(duct - 0.014);
  dy = y - duct;
  length = Sqrt(dx*dx + dy*dy);
  tx = dx/length;
  ty = dy/length;
  p = newp;
  Point(p) = {x - root*tx + flap/2*ty, s*(duct - root*ty - flap/2*tx), 0};
  Point(p + 1) = {x + dx + flap/2*ty, s*(y - flap/2*tx), 0};
  Point(p + 2) = {x + dx + flap/2*tx, s*(y + flap/2*ty), 0};
  Point(p + 3) = {x + dx - flap/2*ty, s*(y + flap/2*tx), 0};
  Point(p + 4) = {x - root*tx - flap/2*ty, s*(duct - root*ty + flap/2*tx), 0};
  Point(p + 5) = {x + dx, s*y, 0};
  l = newl;
  Line(l) = {p, p + 1};
  Circle(l + 1) = {p + 1, p + 5, p + 2};
  Circle(l + 2) = {p + 2, p + 5, p + 3};
  Line(l + 3) = {p + 3, p + 4};
  Line(l + 4) = {p + 4, p};
  held[] += l + 4;
  Curve Loop(3 + k) = {l:l + 4};
  Plane Surface(3 + k) = {3 + k};
EndFor
Recombine Surface{:};
ReverseMesh Surface{2, 4, 6};
Physical Curve("held") = held[];
Physical Curve("upper") = pushed[0];
Physical Curve("lower") = pushed[1];
Physical Surface("walls") = {1, 2};
Physical Surface("flaps") = {3:6};
