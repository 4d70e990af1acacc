# SPDX-License-Identifier: BSD-3-Clause
"""Mutations of a scene as a tree of keys and values. Scalars are texts; the scene loses its comments."""
import copy
import sys
from pathlib import Path

import yaml

sys.path.append(str(Path(__file__).resolve().parents[1] / "metamorphic"))
import scene as scenes  # noqa: E402  its writer of YAML that leaves scalars alone
import texts  # noqa: E402

OTHER_KINDS = ["", "~", "true", "false", "no", "1", "-1", "0.5", "text", "x_min", "t", "x", "${n}", "${nothing}", "1 +", "1/0", "sqrt(-1)", "0/0", "log(0)", "1e999",
               "t < 0.5 ? 0 : 1", [], {}, ["1"], ["1", "2", "3", "4"], [["1"]], [None], {"a": "1"}, {"type": "text"}, {"type": ["1"]}, [{}], ["${n}", "t"]]


def read(data):
    """The tree of a scene, all scalars as text."""
    return yaml.load(data, Loader=yaml.BaseLoader)


def write(tree):
    """A tree as YAML."""
    return yaml.dump(tree, Dumper=scenes.Dumper, allow_unicode=True).encode()


def places(tree):
    """(container, key) of all values."""
    entries = tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else ()
    for key, value in list(entries):
        yield tree, key
        yield from places(value)


def _pick(rng, tree, kind=object):
    found = [(where, key) for where, key in places(tree) if isinstance(where[key], kind)]
    return rng.choice(found) if found else (None, None)


def remove(rng, tree, _):
    """A key or an entry."""
    where, key = _pick(rng, tree)
    del where[key]


def rename(rng, tree, _):
    """A key is misspelt."""
    found = [(where, key) for where, key in places(tree) if isinstance(where, dict)]
    where, key = rng.choice(found)
    other = (texts.misspell(rng, key.encode()) or b"x").decode(errors="replace") if rng.random() < 0.7 else rng.choice(found)[1]
    if other in where:
        return
    items = [(other if k == key else k, v) for k, v in where.items()]
    where.clear()
    where.update(items)


def move(rng, tree, _):
    """A key stands elsewhere."""
    where, key = _pick(rng, tree)
    value = where.pop(key)
    target = rng.choice([w[k] for w, k in places(tree) if isinstance(w[k], (dict, list))] or [tree])
    if isinstance(target, dict):
        target[str(key)] = value
    else:
        target.insert(rng.randrange(len(target) + 1), value)


def other_kind(rng, tree, _):
    """A value of another kind."""
    where, key = _pick(rng, tree)
    where[key] = copy.deepcopy(rng.choice(OTHER_KINDS))


def wrap(rng, tree, _):
    """A value within a list or an object, or the first of a list in its place."""
    where, key = _pick(rng, tree)
    value = where[key]
    inner = next(iter(value.values() if isinstance(value, dict) else value), value) if isinstance(value, (dict, list)) else [value]
    where[key] = rng.choice([[value], {"type": value}, {"value": value}, inner])


def resize(rng, tree, _):
    """A list of another length, or turned round."""
    where, key = _pick(rng, tree, list)
    if where is None:
        return
    entries = where[key]
    where[key] = rng.choice([entries[:-1], entries[1:], entries + entries[-1:], [], entries[::-1], entries * 2, entries + ["0"]])


def exchange(rng, tree, _):
    """Two values have changed places."""
    (one, a), (other, b) = _pick(rng, tree), _pick(rng, tree)
    try:
        one[a], other[b] = other[b], one[a]
        write(tree)
    except RecursionError:
        one[a] = "within itself"


def other_name(rng, tree, _):
    """A name of something else of the scene where a word stands."""
    names = [name for part in ("fields", "meshes", "interfaces", "parameters") if isinstance(tree.get(part), dict) for name in tree[part]]
    names += ["x_min", "x_max", "y_min", "z_max", "outer", "1", "time", "title", "all"] + [w[k] for w, k in places(tree) if k in ("on", "quantity", "type", "what", "of", "that")]
    where, key = _pick(rng, tree, str)
    where[key] = rng.choice(names)


def number(rng, tree, _):
    """A number: sign, size, none at all."""
    found = [(w, k) for w, k in places(tree) if isinstance(w[k], str) and texts.NUMBER.search(w[k].encode())]
    if found:
        where, key = rng.choice(found)
        where[key] = texts.change_number(rng, where[key].encode()).decode()


def expression(rng, tree, _):
    """An expression is damaged."""
    found = [(w, k) for w, k in places(tree) if isinstance(w[k], str) and any(c in w[k] for c in "*/+^(<") and "source" != k]
    if not found:
        return
    where, key = rng.choice(found)
    way = rng.choice([texts.damage_brackets, texts.damage_operator, texts.misspell, texts.change_number, texts.remove_bytes, texts.double_bytes, texts.other_word])
    where[key] = (way(rng, where[key].encode()) or b"").decode(errors="replace")


def foreign(rng, tree, other):
    """A block of another scene, added or in place of one."""
    blocks = [(w, k) for w, k in places(other) if isinstance(w[k], (dict, list))]
    source, name = rng.choice(blocks)
    value = copy.deepcopy(source[name])
    same = [(w, k) for w, k in places(tree) if k == name]
    if same and rng.random() < 0.6:
        where, key = rng.choice(same)
        where[key] = value
        return
    where, key = _pick(rng, tree, (dict, list))
    target = where[key] if where else tree
    target.update({str(name): value}) if isinstance(target, dict) else target.append(value)


ALL = {"key removed": remove, "key misspelt": rename, "key moved": move, "value of another kind": other_kind, "value wrapped": wrap, "list resized": resize,
       "values exchanged": exchange, "name of something else": other_name, "number in the tree": number, "expression damaged": expression,
       "block of another scene": foreign}


def apply(rng, way, data, other):
    """A scene with one mutation of its tree. @param other another scene @returns None where it holds no tree any more"""
    tree = read(data)
    if not isinstance(tree, dict) or not tree:
        return None
    way(rng, tree, read(other))
    return write(tree)
