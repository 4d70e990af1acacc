# SPDX-License-Identifier: BSD-3-Clause
"""Mutations of a scene by what YAML offers: anchors, aliases, cycles, merge keys, tags, documents, depth, size, encodings."""
import re

VALUE = re.compile(rb"(?<=: )[^\s\[\]{},#'\"][^\[\]{},#\n'\"]*")
BLOCK = re.compile(rb"^(\w[\w-]*):[ ]*$", re.M)


def _at_value(rng, data, make):
    found = list(VALUE.finditer(data))
    if not found:
        return None
    match = rng.choice(found)
    return data[:match.start()] + make(match.group()) + data[match.end():]


def anchor(rng, data):
    """An anchor at a value, and mostly an alias at another one."""
    marked = _at_value(rng, data, lambda value: b"&a " + value)
    if marked is None or rng.random() < 0.3:
        return marked
    return _at_value(rng, marked, lambda value: value if value.startswith(b"&") else b"*a")


def cycle(rng, data):
    """An alias within what it stands for."""
    found = list(BLOCK.finditer(data))
    if not found:
        return None
    match = rng.choice(found)
    return data[:match.end()] + b" &loop\n  again: *loop" + data[match.end():]


def merge(rng, data):
    """A merge key of YAML 1.1."""
    found = list(BLOCK.finditer(data))
    if not found:
        return None
    match = rng.choice(found)
    return data[:match.end()] + rng.choice([b"\n  <<: {a: 1}", b"\n  <<: *base", b"\n  <<: [{a: 1}, {b: 2}]", b"\n  ? [a, b]\n  : c"]) + data[match.end():]


def tag(rng, data):
    """A tag before a value."""
    return _at_value(rng, data, lambda value: rng.choice([b"!!str ", b"!!int ", b"!!float ", b"!!binary ", b"!python/object:os.system ", b"!<x> ", b"!x "]) + value)


def quote(rng, data):
    """A value within quotes, with escapes at times."""
    return _at_value(rng, data, lambda value: rng.choice([b'"%s"', b"'%s'", b'"%s\\u0000"', b'"%s\\e[0m"', b'"\\x%s"', b'"%s\\n"', b"|\n  %s\n", b">-\n  %s\n"]) % value)


def nest(rng, data):
    """A value deep within lists or objects; unclosed at times."""
    depth = rng.choice([5, 23, 30, 300, 20000])
    opened, closed = rng.choice([(b"[", b"]"), (b"{a: ", b"}"), (b"- ", b""), (b"[", b""), (b"(", b")"), (b"-", b""), (b"? ", b"")])
    return _at_value(rng, data, lambda value: opened * depth + value + closed * depth)


def long_value(rng, data):
    """A very long word, number or sum."""
    size = rng.choice([300, 5000, 70000, 1200000])
    return _at_value(rng, data, lambda value: rng.choice([b"a" * size, b"1" * size, b"+1" * (size // 2), b"(" * size, b"sin(" * (size // 4), b"x" + b" " * size,
                                                        value + b"\xc3\xa4" * (size // 2), b"-" * size, b"1?" * (size // 2), b"2^" * (size // 2) + b"2"]))


def many(rng, data):
    """Very many entries."""
    count = rng.choice([300, 20000, 120000])
    return _at_value(rng, data, lambda value: rng.choice([b"[" + b"1," * count + b"1]", b"{" + b"".join(b"k%d: 1," % i for i in range(count)) + b"}",
                                                        b"[" + (value + b",") * min(count, 2000) + value + b"]"]))


def documents(rng, data):
    """More than one document, or marks of documents."""
    at = rng.choice([0, len(data)] + [m.end() for m in re.finditer(rb"\n", data)])
    return data[:at] + rng.choice([b"---\n", b"...\n", b"--- 1\n", b"%YAML 1.1\n---\n", b"%TAG ! x\n---\n", b"...\n---\na: 1\n", b"# yes\n", b"? a\n", b"- a\n", b"<<: {}\n"]) + data[at:]


def encode(rng, data):
    """Another encoding or other ends of lines."""
    way = rng.randrange(8)
    if way < 4:
        return [data.replace(b"\n", b"\r\n"), data.replace(b"\n", b"\r"), b"\xef\xbb\xbf" + data, data.replace(b"  ", b"\t")][way]
    codings = ["utf-16", "utf-16-be", "utf-32", "latin-1"]
    return data.replace(b"title: ", b"title: \xc3\xa4 ").decode(errors="replace").encode(codings[way - 4], errors="replace")


def whole(rng, data):
    """Something else in place of the scene."""
    return rng.choice([b"", b"\n", b" ", b"#", b"~", b"null", b"1", b"title", b"[]", b"{}", b"- a\n", b"---", b"\0" * 1000, b"\xff" * 1000, b"{" * 100000, b"[" * 100000,
                       b"- " * 50000, b"a: " * 1000, b"&a [*a]", b"%", b"!!python/object/apply:os.system [ls]", data * 2, data[::-1], data.upper(), b"title: x\n" * 2000])


ALL = {"anchor, alias": anchor, "cycle": cycle, "merge key": merge, "tag": tag, "quotes": quote, "nested deeply": nest, "long value": long_value,
       "many entries": many, "documents": documents, "encoding": encode, "another file": whole}
