# SPDX-License-Identifier: GPL-3.0-or-later
"""Cryptomatte ids: MurmurHash3_32 of a name, made safe to hold in a float."""

_ALL = 0xFFFFFFFF


def murmur3_32(data, seed=0):
    """MurmurHash3 (x86, 32 bit) of bytes, as an unsigned integer."""
    value = seed
    whole = len(data) // 4 * 4
    for start in range(0, whole, 4):
        value ^= _mix(int.from_bytes(data[start:start + 4], "little"))
        value = _rotate(value, 13) * 5 + 0xE6546B64 & _ALL
    if whole < len(data):
        value ^= _mix(int.from_bytes(data[whole:], "little"))
    value ^= len(data)
    value = (value ^ value >> 16) * 0x85EBCA6B & _ALL
    value = (value ^ value >> 13) * 0xC2B2AE35 & _ALL
    return value ^ value >> 16


def cryptomatte_hex(name):
    """Eight hex digits of the id that pixels hold for a name."""
    return f"{float_safe(murmur3_32(name.encode('utf-8'))):08x}"


def float_safe(value):
    """The hash with its lowest exponent bit flipped where all exponent bits are alike.

    As a float it would be a denormal, an infinity or not a number. Blender's pixels hold the
    changed bits, while its manifest keeps the hash as it is.
    """
    return value ^ 1 << 23 if value >> 23 & 0xFF in (0, 0xFF) else value


def _rotate(value, bits):
    return (value << bits | value >> 32 - bits) & _ALL


def _mix(block):
    return _rotate(block * 0xCC9E2D51 & _ALL, 15) * 0x1B873593 & _ALL
