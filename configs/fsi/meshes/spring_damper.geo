// A stamp on a disc with two holes, carried by two helical springs; thesis 3.6. Hexahedra: a plane mesh,
// swept upwards, and downwards along the screw. The springs' circular section lies in a plane through the
// axis, so what a horizontal plane cuts out of them is the same everywhere, but for a rotation.
DefineConstant[ h = 0.05 ];  // edge of a cell
pitch = 1; radius = 0.3; section = 0.07; bottom = -0.61; thickness = 0.07; top = 0.57;
turn = 2*Pi/pitch;           // of the screw per height
start = Pi + turn*0.68;      // where the first spring meets the disc

Point(1) = {0, 0, 0};
// Circles: the disc, the stamp, and the two holes.
centre[] = {0, 0, 0, 0, radius, 0, -radius, 0};
size[] = {0.5, 0.15, 0.1, 0.1};
For i In {0:3}
  c = newp; Point(c) = {centre[2*i], centre[2*i + 1], 0};
  p[] = {};
  For k In {0:3}
    p[k] = newp;
    Point(p[k]) = {centre[2*i] + size[i]*Cos(k*Pi/2), centre[2*i + 1] + size[i]*Sin(k*Pi/2), 0};
  EndFor
  l[] = {};
  For k In {0:3}
    l[k] = newl; Circle(l[k]) = {p[k], c, p[(k + 1)%4]};
  EndFor
  loop[i] = newll; Curve Loop(loop[i]) = {l[]};
EndFor
// Horizontal sections of the springs.
For i In {0:1}
  p[] = {};
  n = 32;
  For k In {0:n-1}
    angle = start + i*Pi + turn*section*Cos(2*Pi*k/n);
    r = radius + section*Sin(2*Pi*k/n);
    p[k] = newp; Point(p[k]) = {r*Cos(angle), r*Sin(angle), 0};
  EndFor
  a = newl; Spline(a) = {p[{0:n/2}]};
  b = newl; Spline(b) = {p[{n/2:n-1}], p[0]};
  loop[4 + i] = newll; Curve Loop(loop[4 + i]) = {a, b};
EndFor
stamp = news; Plane Surface(stamp) = {loop[1]};
foot[0] = news; Plane Surface(foot[0]) = {loop[4]};
foot[1] = news; Plane Surface(foot[1]) = {loop[5]};
plate = news; Plane Surface(plate) = {loop[0], loop[{1:5}]};
Recombine Surface{stamp, foot[], plate};

volumes[] = {};
parts[] = {stamp, foot[], plate};
For i In {0:3}
  s = parts[i];
  out[] = Extrude {0, 0, thickness} { Surface{s}; Layers{Ceil(thickness/h)}; Recombine; };
  volumes[] += out[1];
  If (i == 0)
    out[] = Extrude {0, 0, top - thickness} { Surface{out[0]}; Layers{Ceil((top - thickness)/h)}; Recombine; };
    volumes[] += out[1];
    Physical Surface("top") = {out[0]};
  EndIf
EndFor
// By less than half a turn at a time.
ends[] = {};
For i In {0:1}
  s = foot[i];
  For k In {1:3}
    out[] = Extrude { {0, 0, bottom/3}, {0, 0, 1}, {0, 0, 0}, turn*bottom/3 } {
      Surface{s}; Layers{Ceil(-bottom/3/h)}; Recombine;
    };
    volumes[] += out[1];
    s = out[0];
  EndFor
  ends[] += s;
EndFor
Physical Surface("bottom") = {ends[]};
Physical Volume("damper") = {volumes[]};
// Recombination halves what it is given.
Mesh.CharacteristicLengthMin = 2*h;
Mesh.CharacteristicLengthMax = 2*h;
Mesh.Algorithm = 5;
Mesh.RecombinationAlgorithm = 2;  // quadrilaterals only
