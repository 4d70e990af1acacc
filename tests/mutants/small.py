# SPDX-License-Identifier: BSD-3-Clause
"""The shipped scenes on meshes so coarse that a check takes a part of a second: the same in all but some numbers."""
import re
from pathlib import Path

CONFIGS = Path(__file__).resolve().parents[2] / "configs"

# What the parameters of a scene become, where its own mesh is fine.
COARSE = {
    "contact/elastic_pump.yaml": {"n": "0.5"}, "contact/hertz.yaml": {"h": "0.2", "fine": "0.02"}, "contact/leaflet_valve.yaml": {"n": "12", "h": "0.012"},
    "contact/round_valve.yaml": {"n": "3", "h": "0.03"}, "contact/squeezed_disc.yaml": {"n": "10", "h": "0.15", "h_disc": "0.08"},
    "contact/sinking_disc.yaml": {"n": "8"}, "contact/bouncing_disc.yaml": {"n": "8"},
    "fluid/approach_2d.yaml": {"n": "2"}, "fluid/approach_3d.yaml": {"n": "1"}, "fluid/cavity.yaml": {"n": "6"}, "fluid/cfd1.yaml": {"n": "3"},
    "fluid/cfd2.yaml": {"n": "2"}, "fluid/dfg_2d_1.yaml": {"n": "12"}, "fluid/dfg_2d_2.yaml": {"n": "12"}, "fluid/shear_3d.yaml": {"n": "3"},
    "fluid/sphere.yaml": {"n": "5"}, "fluid/spirals.yaml": {"n": "4"}, "fluid/oscillating_cylinder.yaml": {"n": "8"},
    "fsi/c04_full.yaml": {"n": "16", "sides": "24"}, "fsi/spring_damper.yaml": {"h": "0.06", "n": "4", "m": "4", "layers": "6"},
    "fsi/spring_damper_quarter.yaml": {"h": "0.12", "n": "3"}, "fsi/spring_damper_2d.yaml": {"h": "0.1"}, "fsi/turek_hron_fsi1.yaml": {"n": "2"},
    "fsi/turek_hron_fsi2.yaml": {"n": "2"}, "poro/bending_beam.yaml": {"m": "1", "h": "0.06"}, "poro/bending_beam_patch.yaml": {"m": "1", "h": "0.06", "layers": "2"},
    "poro/plate.yaml": {"n": "0.5"}, "poro/plate_3d.yaml": {"n": "0.4"}, "poro/filter.yaml": {"n": "6"}, "poro/c07.yaml": {"n": "6"},
    "solid/block.yaml": {"n": "4"}, "solid/cook.yaml": {"n": "6"}, "solid/cook_incompressible.yaml": {"n": "4"},
}


def coarse(name, text):
    """A scene with parameters of a coarser mesh."""
    for parameter, value in COARSE.get(name, {}).items():
        text = re.sub(rf"(?m)^(parameters: .*?\b{parameter}: )[^,}}\n]+", rf"\g<1>{value}", text)
    return text


def scenes():
    """(name below configs, text) of every shipped scene."""
    paths = sorted(CONFIGS.rglob("*.yaml"))
    return [(name, coarse(name, path.read_text())) for path in paths for name in [str(path.relative_to(CONFIGS))]]
