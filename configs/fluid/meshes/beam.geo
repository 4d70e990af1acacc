// The flag of Turek and Hron: 0.35 long behind a cylinder that it reaches into.
Point(1) = {0.22, 0.19, 0, 0.02};
Point(2) = {0.6, 0.19, 0, 0.02};
Point(3) = {0.6, 0.21, 0, 0.02};
Point(4) = {0.22, 0.21, 0, 0.02};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Curve("surface") = {1, 2, 3, 4};
Physical Surface("beam") = {1};
