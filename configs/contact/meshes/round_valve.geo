// Half (z <= 0) of a tube along x with two leaflets that lean towards -x, with round free edges that nearly meet.
SetFactory("OpenCASCADE");
DefineConstant[
  h = 0.008,         // size of the cells
  long = 0.3,        // length of the tube
  inner = 0.05,      // its radius
  wall = 0.0075,     // and its thickness
  leaflet = 0.012,   // thickness of the leaflets
  clear = 0.0042     // distance of their free edges
];
Mesh.MeshSizeMin = h/4;
Mesh.MeshSizeMax = h;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeFromCurvature = 10;  // cells round a full turn: coarse free edges would be sharp
// A leaflet's middle plane runs from (0.19, inner) along (tx, ty); it aims at (0.145, 0.0064).
length = Sqrt(0.045^2 + 0.0436^2);
tx = -0.045/length;
ty = -0.0436/length;
half = leaflet/2;
y = clear/2 + half;           // where the free edge's axis is
x = 0.19 + (y - inner)*tx/ty;
far = 0.11;                   // beyond the wall
For k In {0:1}
  s = 1 - 2*k;
  p = newp;
  Point(p) = {x + half*ty, s*(y - half*tx), 0};
  Point(p + 1) = {x + half*tx, s*(y + half*ty), 0};
  Point(p + 2) = {x - half*ty, s*(y + half*tx), 0};
  Point(p + 3) = {x - half*ty - far*tx, s*(y + half*tx - far*ty), 0};
  Point(p + 4) = {x + half*ty - far*tx, s*(y - half*tx - far*ty), 0};
  Point(p + 5) = {x, s*y, 0};
  l = newl;
  Circle(l) = {p, p + 5, p + 1};
  Circle(l + 1) = {p + 1, p + 5, p + 2};
  Line(l + 2) = {p + 2, p + 3};
  Line(l + 3) = {p + 3, p + 4};
  Line(l + 4) = {p + 4, p};
  outline = newll;
  Curve Loop(outline) = {l:l + 4};
  profile = news;
  Plane Surface(profile) = {outline};
  out() = Extrude {0, 0, -2*inner} { Surface{profile}; };
  plate(k) = out(1);
EndFor
outside = newv;
Cylinder(outside) = {0, 0, 0, long, 0, 0, inner + wall};
inside = newv;
Cylinder(inside) = {0, 0, 0, long, 0, 0, inner};
shell = newv;
BooleanDifference(shell) = { Volume{outside}; Delete; }{ Volume{inside}; Delete; };
// The plates reach into the wall.
within = newv;
Cylinder(within) = {0, 0, 0, long, 0, 0, inner + 0.3*wall};
plates() = BooleanIntersection{ Volume{plate()}; Delete; }{ Volume{within}; Delete; };
whole() = BooleanUnion{ Volume{shell}; Delete; }{ Volume{plates()}; Delete; };
half_space = newv;
Box(half_space) = {-long, -2*inner, -2*inner, 3*long, 4*inner, 2*inner};
valve() = BooleanIntersection{ Volume{whole()}; Delete; }{ Volume{half_space}; Delete; };
e = 1e-5;
symmetry() = Surface In BoundingBox{-e, -2*inner, -e, long + e, 2*inner, e};
ends() = Surface In BoundingBox{-e, -2*inner, -2*inner, e, 2*inner, e};
ends() += Surface In BoundingBox{long - e, -2*inner, -2*inner, long + e, 2*inner, e};
outer() = Surface In BoundingBox{-e, -2*inner, -2*inner, long + e, 2*inner, e};
outer() -= {symmetry(), ends(), Surface In BoundingBox{-e, -inner - wall/2, -inner - wall/2, long + e, inner + wall/2, e}};
Physical Surface("symmetry") = symmetry();
Physical Surface("ends") = ends();
Physical Surface("outer") = outer();
Physical Volume("valve") = valve();
