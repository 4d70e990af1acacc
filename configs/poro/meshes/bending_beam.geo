// A beam that stands on the floor of a channel at x = 0.75, with a round tip about (0.75, 0.5). Quadrilaterals: those of the
// stem in rows, those of the tip unstructured.
DefineConstant[
  width = 0.12,   // of the stem
  radius = 0.12,  // of the tip
  h = 0.015       // size of the cells
];
Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 1;
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
x = 0.75;
half = width/2;
joint = 0.5 - Sqrt(radius^2 - half^2);
Point(1) = {x, 0.5, 0};
Point(2) = {x - half, 0, 0};
Point(3) = {x + half, 0, 0};
Point(4) = {x + half, joint, 0};
Point(5) = {x + radius, 0.5, 0};
Point(6) = {x, 0.5 + radius, 0};
Point(7) = {x - radius, 0.5, 0};
Point(8) = {x - half, joint, 0};
Line(1) = {2, 3};
Line(2) = {3, 4};
Line(3) = {4, 8};
Line(4) = {8, 2};
Circle(5) = {4, 1, 5};
Circle(6) = {5, 1, 6};
Circle(7) = {6, 1, 7};
Circle(8) = {7, 1, 8};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {-3, 5, 6, 7, 8};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
// Even numbers, so that no triangle is left over.
across = 2*Round(width/h/2);
Transfinite Curve{1, 3} = across + 1;
Transfinite Curve{2, 4} = Round(joint/h) + 1;
Transfinite Curve{5, 8} = Round(radius*Acos(half/radius)/h) + 1;
Transfinite Curve{6, 7} = Round(radius*Pi/2/h) + 1;
Transfinite Surface{1};
Recombine Surface{1, 2};
Physical Curve("base") = {1};
Physical Surface("beam") = {1, 2};
