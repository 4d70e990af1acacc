// A duct's two walls, at +-0.05, each with a leaflet that leans towards -x, with a round tip that nearly meets the other one.
DefineConstant[
  h = 0.005,         // size of the cells
  wall = 0.0075,     // thickness of the walls
  leaflet = 0.012,   // and of the leaflets
  clear = 0.0042     // distance of the tips
];
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
// The leaflet's middle line runs from (0.19, 0.05) along (tx, ty); it aims at (0.145, 0.0064).
length = Sqrt(0.045^2 + 0.0436^2);
tx = -0.045/length;
ty = -0.0436/length;
half = leaflet/2;
root = half*(tx*tx/ty + ty);  // its sides meet the wall so far from that
y = clear/2 + half;           // where the tip's circle has its centre
x = 0.19 + (y - 0.05)*tx/ty;
For k In {0:1}
  s = 1 - 2*k;
  p = newp;
  Point(p) = {0, s*(0.05 + wall), 0};
  Point(p + 1) = {0, s*0.05, 0};
  Point(p + 2) = {0.19 + root, s*0.05, 0};
  Point(p + 3) = {x + half*ty, s*(y - half*tx), 0};
  Point(p + 4) = {x + half*tx, s*(y + half*ty), 0};
  Point(p + 5) = {x - half*ty, s*(y + half*tx), 0};
  Point(p + 6) = {0.19 - root, s*0.05, 0};
  Point(p + 7) = {0.3, s*0.05, 0};
  Point(p + 8) = {0.3, s*(0.05 + wall), 0};
  Point(p + 9) = {x, s*y, 0};
  l = newl;
  For i In {0:8}
    If (i == 3 || i == 4)
      Circle(l + i) = {p + i, p + 9, p + i + 1};
    Else
      Line(l + i) = {p + i, p + (i + 1)%9};
    EndIf
  EndFor
  ends[] += {l, l + 7};
  outer[] += l + 8;
  Curve Loop(1 + k) = {l:l + 8};
  Plane Surface(1 + k) = {1 + k};
EndFor
Recombine Surface{:};
ReverseMesh Surface{2};
Physical Curve("ends") = ends[];
Physical Curve("outer") = outer[];
Physical Surface("valve") = Surface{:};
