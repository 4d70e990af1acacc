// A block across a channel with a plate behind it: quadrilaterals of a slice, x along the channel and y upwards, or, extruded
// along z over the width of the channel, hexahedra.
DefineConstant[
  spatial = 0,  // 1: in space
  n = 1,        // refines
  fine = 0      // 1: in space, cells of 1/125 as in the source, about 62,000
];
x[] = {0.35, 0.42, 0.43, 0.5, 1};
y[] = {0.175, 0.23, 0.25, 0.27, 0.325};
along[] = {7, 1, 7, 50};
up[] = {6, 2, 2, 6};
If (spatial)
  along[] = {2, 1, 2, 6};
  up[] = {2, 1, 1, 2};
  layers[] = {2, 4, 2};
EndIf
If (spatial && fine)
  along[] = {9, 1, 9, 70};
  up[] = {7, 2, 2, 7};
  layers[] = {32, 64, 32};
EndIf
For i In {0:4}
  For j In {0:4}
    If (i < 4 || (j > 0 && j < 4))
      Point(1 + i + 5*j) = {x[i], y[j], 0};
    EndIf
  EndFor
EndFor
For j In {0:4}
  For i In {0:3}
    If (i < 3 || (j > 0 && j < 4))
      Line(100 + i + 5*j) = {1 + i + 5*j, 2 + i + 5*j};
      Transfinite Curve{100 + i + 5*j} = n*along[i] + 1;
    EndIf
  EndFor
EndFor
For i In {0:4}
  For j In {0:3}
    If (i < 4 || (j > 0 && j < 3))
      Line(200 + i + 5*j) = {1 + i + 5*j, 6 + i + 5*j};
      Transfinite Curve{200 + i + 5*j} = n*up[j] + 1;
    EndIf
  EndFor
EndFor
block[] = {};
plate[] = {};
For i In {0:3}
  For j In {0:3}
    If (i < 3 || (j > 0 && j < 3))
      s = 1 + i + 5*j;
      Curve Loop(s) = {100 + i + 5*j, 201 + i + 5*j, -(105 + i + 5*j), -(200 + i + 5*j)};
      Plane Surface(s) = {s};
      Transfinite Surface{s};
      Recombine Surface{s};
      If (i < 3)
        block[] += s;
      Else
        plate[] += s;
      EndIf
    EndIf
  EndFor
EndFor
If (!spatial)
  Physical Curve("core") = {111};  // on the axis of the block
  Physical Surface("block") = block[];
  Physical Surface("plate") = plate[];
Else
  width[] = {0.251, 0.5, 0.249};
  solid[] = {};
  behind[] = {};
  ends[] = block[];
  front[] = block[];
  For k In {0:2}
    next[] = {};
    For s In {0:#front[] - 1}
      out[] = Extrude {0, 0, width[k]} { Surface{front[s]}; Layers{n*layers[k]}; Recombine; };
      next[] += out[0];
      solid[] += out[1];
    EndFor
    If (k == 0)
      // The plate starts where the first stretch of the block ends.
      below[] = Translate {0, 0, width[0]} { Duplicata { Surface{plate[]}; } };
    EndIf
    front[] = next[];
  EndFor
  ends[] += front[];
  For s In {0:#below[] - 1}
    sides[] = Boundary { Surface{below[s]}; };
    Transfinite Curve{Abs(sides[0]), Abs(sides[2])} = n*along[3] + 1;
    Transfinite Curve{Abs(sides[1]), Abs(sides[3])} = n*up[1 + s] + 1;
    Transfinite Surface{below[s]};
    Recombine Surface{below[s]};
    out[] = Extrude {0, 0, width[1]} { Surface{below[s]}; Layers{n*layers[1]}; Recombine; };
    behind[] += out[1];
  EndFor
  Coherence;
  Physical Surface("held") = ends[];
  Physical Volume("block") = solid[];
  Physical Volume("plate") = behind[];
EndIf
