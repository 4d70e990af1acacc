// Half of a stamp with a rounded foot and a round hole: quadrilaterals in four blocks, three around the hole and one above.
DefineConstant[
  fine = 1,     // refines; 1: 753 cells
  hole = 0.93,  // height of the hole's centre
  order = 1     // of the cells
];
Mesh.ElementOrder = order;
half = 0.75;
clearance = 0.5;
radius = 1;  // of the foot
top = 2;
width = 0.25;  // radius of the hole
rise = radius - Sqrt(radius^2 - half^2);
above = hole + 2*width;
Point(1) = {0, clearance, 0};
Point(2) = {-half, clearance + rise, 0};
Point(3) = {-half, above, 0};
Point(4) = {0, above, 0};
Point(5) = {-half, top, 0};
Point(6) = {0, top, 0};
Point(7) = {0, clearance + radius, 0};
Point(8) = {0, hole, 0};
s = Sqrt(0.5)*width;
Point(11) = {0, hole - width, 0};
Point(12) = {-s, hole - s, 0};
Point(13) = {-s, hole + s, 0};
Point(14) = {0, hole + width, 0};
Circle(1) = {1, 7, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {3, 5};
Line(5) = {5, 6};
Line(6) = {6, 4};
Circle(11) = {11, 8, 12};
Circle(12) = {12, 8, 13};
Circle(13) = {13, 8, 14};
Line(21) = {11, 1};
Line(22) = {12, 2};
Line(23) = {13, 3};
Line(24) = {14, 4};
Transfinite Curve{1, 11, 3, 13, 5} = Ceil(20*fine) + 1;
Transfinite Curve{2, 12} = Ceil(17*fine) + 1;
Transfinite Curve{21, 22, 23, 24} = Ceil(9*fine) + 1;
Transfinite Curve{4, 6} = Ceil(fine*(top - above)/0.038) + 1;
Curve Loop(1) = {11, 22, -1, -21};
Curve Loop(2) = {12, 23, -2, -22};
Curve Loop(3) = {13, 24, -3, -23};
Curve Loop(4) = {3, -6, -5, -4};
For b In {1:4}
  Plane Surface(b) = {b};
  Transfinite Surface{b};
  Recombine Surface{b};
EndFor
Physical Curve("foot") = {1};
Physical Curve("side") = {2, 4};
Physical Curve("top") = {5};
Physical Curve("middle") = {6, 24, 21};
Physical Curve("hole") = {11, 12, 13};
Physical Surface("stamp") = {1:4};
