# SPDX-License-Identifier: BSD-3-Clause
"""Mutations of a text, whatever it says: its bytes, its lines, its words and numbers. Each takes a generator of random numbers
and bytes, and returns other bytes; None where there is nothing to change.
"""
import re

NUMBER = re.compile(rb"(?<![\w.])[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?(?![\w.])")
WORD = re.compile(rb"[A-Za-z_]\w*")
# Bytes that readers stumble over: ends of strings, of lines and of files, signs of YAML and XML, no UTF-8.
ODD_BYTES = [b"\0", b"\x1a", b"\x1b", b"\x7f", b"\xff", b"\xc0\x80", b"\xed\xa0\x80", b"\xe2\x80\xae", b"\xef\xbb\xbf", b"\xc2\x85", b"\t", b"\r",
             b"\n", b" ", b"'", b'"', b"#", b"&", b"*", b"!", b"|", b">", b"%", b"@", b"`", b"{", b"}", b"[", b"]", b",", b":", b"-", b"?", b"<",
             b"$", b"\\", b"\xe2\x88\x92", b"\xc2\xa0"]
ODD_NUMBERS = [b"0", b"-0", b"nan", b"inf", b"-inf", b".nan", b".inf", b"1e308", b"-1e308", b"1e400", b"1e-400", b"4.9e-324", b"2147483647", b"2147483648",
               b"-2147483649", b"4294967296", b"9223372036854775807", b"9223372036854775808", b"18446744073709551616", b"1e15", b"0.1e", b"1..2",
               b"0x10", b"1_000", b"1,5", b"007", b"+", b"-", b"1e+", b"9" * 400]


def flip_bit(rng, data):
    """One bit."""
    if not data:
        return None
    at = rng.randrange(len(data))
    return data[:at] + bytes([data[at] ^ 1 << rng.randrange(8)]) + data[at + 1:]


def remove_bytes(rng, data):
    """One byte, or some."""
    if not data:
        return None
    at, count = rng.randrange(len(data)), rng.choice([1, 1, 1, 3, 20])
    return data[:at] + data[at + count:]


def insert_byte(rng, data):
    """A byte, or a few that belong together."""
    at = rng.randrange(len(data) + 1)
    return data[:at] + (rng.choice(ODD_BYTES) if rng.random() < 0.8 else bytes([rng.randrange(256)])) + data[at:]


def double_bytes(rng, data):
    """A run of bytes stands there twice."""
    if not data:
        return None
    at, count = rng.randrange(len(data)), rng.choice([1, 2, 10, 60])
    return data[:at + count] + data[at:]


def cut_short(rng, data):
    """The file ends early, often at the beginning."""
    return data[:rng.randrange(len(data))] if data and rng.random() < 0.9 else b""


def without_line(rng, data):
    """A line is missing."""
    lines = data.splitlines(True)
    if lines:
        del lines[rng.randrange(len(lines))]
    return b"".join(lines)


def line_twice(rng, data):
    """A line stands there twice."""
    lines = data.splitlines(True)
    if not lines:
        return None
    at = rng.randrange(len(lines))
    return b"".join(lines[:at + 1] + lines[at:])


def swap_lines(rng, data):
    """Two lines have changed places."""
    lines = data.splitlines(True)
    if len(lines) < 2:
        return None
    one, other = rng.sample(range(len(lines)), 2)
    lines[one], lines[other] = lines[other], lines[one]
    return b"".join(lines)


def indent_line(rng, data):
    """A line stands further left or right, or begins with a tab."""
    lines = data.splitlines(True)
    if not lines:
        return None
    at = rng.randrange(len(lines))
    bare = lines[at].lstrip(b" ")
    lines[at] = rng.choice([b" " * rng.randrange(9), b"\t", b"  \t"]) + bare
    return b"".join(lines)


def join_lines(rng, data):
    """The end of a line is missing."""
    ends = [m.start() for m in re.finditer(rb"\n", data)]
    return data[:(at := rng.choice(ends))] + data[at + 1:] if ends else None


def change_number(rng, data):
    """A number: sign, size, none at all."""
    found = list(NUMBER.finditer(data))
    if not found:
        return None
    match = rng.choice(found)
    return data[:match.start()] + other_number(rng, match.group()) + data[match.end():]


def other_number(rng, text):
    """Another number for one."""
    way = rng.randrange(4)
    if way == 0:
        return text[1:] if text.startswith(b"-") else b"-" + text
    if way == 1:
        return text + b"e%d" % rng.choice([-30, -15, -9, -3, -2, -1, 1, 2, 3, 9, 15, 30, 300]) if b"e" not in text.lower() else text.split(b"e")[0]
    if way == 2 and text.isdigit():
        return b"%d" % max(0, int(text) + rng.choice([-1, 1, 2]))
    return rng.choice(ODD_NUMBERS)


def misspell(rng, data):
    """A letter of a word is another one, missing, or there twice."""
    found = list(WORD.finditer(data))
    if not found:
        return None
    match = rng.choice(found)
    word, at = match.group(), rng.randrange(len(match.group()))
    letter = bytes([rng.choice(b"abcdefghijklmnopqrstuvwxyz_XYZ019")])
    other = rng.choice([word[:at] + letter + word[at + 1:], word[:at] + word[at + 1:], word[:at] + word[at:at + 1] + word[at:], word.upper()])
    return data[:match.start()] + other + data[match.end():]


def other_word(rng, data):
    """A word of the file stands where another one stood."""
    found = list(WORD.finditer(data))
    if len(found) < 2:
        return None
    match, other = rng.sample(found, 2)
    return data[:match.start()] + other.group() + data[match.end():]


def damage_brackets(rng, data):
    """A bracket or a quotation mark is missing, there twice, or another one."""
    found = [m.start() for m in re.finditer(rb"[\[\]{}()'\"]", data)]
    if not found:
        return None
    at = rng.choice(found)
    return data[:at] + rng.choice([b"", data[at:at + 1] * 2, rng.choice([b"[", b"]", b"{", b"}", b"(", b")"])]) + data[at + 1:]


def damage_operator(rng, data):
    """An operator is another one, missing, or there twice."""
    found = [m.start() for m in re.finditer(rb"(?<=\w|\))\s*[-+*/^<>=?:|&]", data)]
    if not found:
        return None
    at = rng.choice(found)
    ops = [b"+", b"-", b"*", b"/", b"^", b"%", b"<", b">", b"=", b"==", b"&&", b"||", b"?", b":", b":=", b";", b"!", b"~", b""]
    return data[:at] + rng.choice(ops) + data[at + 1:]


BYTES = {"bit flipped": flip_bit, "bytes removed": remove_bytes, "byte inserted": insert_byte, "bytes doubled": double_bytes, "cut short": cut_short}
LINES = {"line removed": without_line, "line doubled": line_twice, "lines swapped": swap_lines, "line indented": indent_line, "lines joined": join_lines}
WORDS = {"number changed": change_number, "word misspelt": misspell, "word exchanged": other_word, "bracket damaged": damage_brackets,
         "operator damaged": damage_operator}
