# SPDX-License-Identifier: BSD-3-Clause
"""Pictures that a browser took: PNG with 8 bits a channel, not interlaced."""
import struct
import zlib


def _unfiltered(kind, line, above, step):
    """A line of bytes as it was before one of PNG's five filters."""
    for i, value in enumerate(line):
        left = line[i - step] if i >= step else 0
        up = above[i]
        if kind == 1:
            guess = left
        elif kind == 2:
            guess = up
        elif kind == 3:
            guess = (left + up) // 2
        else:
            corner = above[i - step] if i >= step else 0
            sides = left + up - corner
            guess = min((left, up, corner), key=lambda side: abs(sides - side))
        line[i] = (value + guess) & 255
    return line


def read_png(data):
    """Rows of (r, g, b)."""
    width, height, depth, colour, _, _, interlaced = struct.unpack(">IIBBBBB", data[16:29])
    assert depth == 8 and colour in (2, 6) and not interlaced
    step = 3 if colour == 2 else 4
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        if kind == b"IDAT":
            packed += data[at + 8 : at + 8 + length]
        at += length + 12
    raw = zlib.decompress(packed)
    rows, above = [], bytearray(width * step)
    for y in range(height):
        start = y * (width * step + 1)
        line = bytearray(raw[start + 1 : start + 1 + width * step])
        above = _unfiltered(raw[start], line, above, step) if raw[start] else line
        rows.append([tuple(above[x : x + 3]) for x in range(0, len(above), step)])
    return rows


def shrunk(rows, times):
    """The means of squares of so many pixels each way."""
    small = []
    for y in range(0, len(rows) - times + 1, times):
        small.append([])
        for x in range(0, len(rows[0]) - times + 1, times):
            square = [pixel for row in rows[y : y + times] for pixel in row[x : x + times]]
            small[-1].append(tuple(round(sum(p[k] for p in square) / len(square)) for k in range(3)))
    return small


def share_unlike(rows, colour, limit=24):
    """Share of the pixels that differ from a colour by more than `limit` in some channel."""
    count = sum(max(abs(a - b) for a, b in zip(p, colour)) > limit for row in rows for p in row)
    return count / sum(len(row) for row in rows)


def share_changed(rows, others, limit=24):
    """Share of the pixels in which two pictures of one size differ."""
    changed = total = 0
    for row, other in zip(rows, others):
        total += len(row)
        changed += sum(max(abs(a - b) for a, b in zip(p, q)) > limit for p, q in zip(row, other))
    return changed / total


def brightness(rows):
    """Mean of all channels, 0 to 255."""
    return sum(sum(p) for row in rows for p in row) / (3 * sum(len(row) for row in rows))
