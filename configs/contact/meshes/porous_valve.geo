// The bodies of leaflet_valve: a duct's two walls (part 0), or the two leaflets (part 1), whose nodes on `root` are the walls'.
DefineConstant[
  part = 0,
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
  Point(p) = {0.19 + root, s*0.05, 0};
  Point(p + 1) = {0.19 - root, s*0.05, 0};
  l = newl;
  Line(l) = {p, p + 1};
  roots[] += l;
  If (part)
    Point(p + 2) = {x + half*ty, s*(y - half*tx), 0};
    Point(p + 3) = {x + half*tx, s*(y + half*ty), 0};
    Point(p + 4) = {x - half*ty, s*(y + half*tx), 0};
    Point(p + 5) = {x, s*y, 0};
    Line(l + 1) = {p, p + 2};
    Circle(l + 2) = {p + 2, p + 5, p + 3};
    Circle(l + 3) = {p + 3, p + 5, p + 4};
    Line(l + 4) = {p + 4, p + 1};
    Curve Loop(1 + k) = {l + 1, l + 2, l + 3, l + 4, -l};
  Else
    Point(p + 2) = {0.3, s*0.05, 0};
    Point(p + 3) = {0.3, s*(0.05 + wall), 0};
    Point(p + 4) = {0, s*(0.05 + wall), 0};
    Point(p + 5) = {0, s*0.05, 0};
    For i In {1:4}
      Line(l + i) = {p + i, p + i + 1};
    EndFor
    Line(l + 5) = {p + 5, p};
    ends[] += {l + 2, l + 4};
    outer[] += l + 3;
    Curve Loop(1 + k) = {l:l + 5};
  EndIf
  Plane Surface(1 + k) = {1 + k};
EndFor
Recombine Surface{:};
ReverseMesh Surface{2};
If (!part)
  Physical Curve("ends") = ends[];
  Physical Curve("outer") = outer[];
EndIf
Physical Curve("root") = roots[];
Physical Surface("bodies") = {1, 2};
