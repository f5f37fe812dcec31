"""Writes pictures of formats that oiiotool reads but does not write, from an 8-bit PPM.

make_pictures.py PPM FOLDER: flat.psd, alpha.psd, cmyk.psd, flat.dds, alpha.dds, flat.pic, log.cin, scan.dcm
The files with alpha have 0.5 all over. After the formats' published layouts.
"""
import struct
import sys


def read_ppm(path):
    with open(path, 'rb') as file:
        data = file.read()
    magic, width, height, most = data.split(None, 4)[:4]
    assert magic == b'P6' and most == b'255'
    width, height = int(width), int(height)
    return width, height, data[-width * height * 3:]


def psd(width, height, channels, mode, alpha):
    """Planes of 8 bits; a negative layer count says that the last one is alpha."""
    layers = struct.pack('>Ih', 4, -1 if alpha else 0) + b'\0\0' if alpha else b''
    if alpha:
        layer = struct.pack('>4iH', 0, 0, 0, 0, 0) + b'8BIMnorm' + struct.pack('>4BI', 255, 0, 0, 0, 12)
        layer += struct.pack('>II', 0, 0) + b'\0\0\0\0'
        info = struct.pack('>h', -1) + layer
        info += b'\0' * (len(info) % 2)
        layers = struct.pack('>I', len(info)) + info + struct.pack('>I', 0)
    header = b'8BPS' + struct.pack('>H6xHIIHH', 1, len(channels), height, width, 8, mode)
    return (header + struct.pack('>III', 0, 0, len(layers)) + layers + struct.pack('>H', 0)
            + b''.join(channels))


def dds(width, height, pixels, alpha):
    """Uncompressed, blue first."""
    step = 4 if alpha else 3
    flags = 0x41 if alpha else 0x40
    header = struct.pack('<4s7I44x', b'DDS ', 124, 0x100f, height, width, width * step, 0, 0)
    header += struct.pack('<8I', 32, flags, 0, step * 8, 0xff0000, 0xff00, 0xff,
                          0xff000000 if alpha else 0)
    header += struct.pack('<5I', 0x1000, 0, 0, 0, 0)
    body = bytearray()
    for i in range(width * height):
        r, g, b = pixels[3 * i:3 * i + 3]
        body += bytes((b, g, r, 128)) if alpha else bytes((b, g, r))
    return header + bytes(body)


def softimage(width, height, pixels):
    """One packet of red, green, blue, by mixed runs of one pixel each."""
    header = struct.pack('>If80s4sHHfHH', 0x5380F634, 3.71, b'', b'PICT', width, height, 1.0, 3, 0)
    return header + bytes((0, 8, 2, 0xe0)) + b''.join(
        b'\0' + pixels[at:at + 3] for at in range(0, len(pixels), 3))


def cineon(width, height, pixels):
    """10 bits, three to a word, as a scanner writes printing densities."""
    header = bytearray(b'\xff' * 1024)
    struct.pack_into('>5I', header, 0, 0x802A5FD7, 1024, 1024, 0, 1024 + 4 * width * height)
    struct.pack_into('>2I', header, 20, 1024 + 4 * width * height, 0)
    struct.pack_into('8s', header, 24, b'V4.5')
    header[192:196] = bytes((0, 3, 255, 255))
    for channel in range(8):
        struct.pack_into('>BBBBIIffff', header, 196 + 28 * channel, 0, channel + 1 if channel < 3 else 0,
                         10, 0, width, height, 0, 0, 1023, 2.048)
    header[680:688] = bytes((0, 5, 0, 0, 0, 0, 0, 0))
    struct.pack_into('>2I', header, 684, 0, 0)
    words = [(pixels[3 * i] * 4) << 22 | (pixels[3 * i + 1] * 4) << 12 | (pixels[3 * i + 2] * 4) << 2
             for i in range(width * height)]
    return bytes(header) + struct.pack('>%dI' % len(words), *words)


def dicom(width, height, pixels):
    """Explicit little endian, one grey channel."""
    def element(group, number, kind, value):
        value += b'\0' * (len(value) % 2)
        size = struct.pack('<2xI', len(value)) if kind in (b'OB', b'OW') else struct.pack('<H', len(value))
        return struct.pack('<HH', group, number) + kind + size + value

    syntax = element(2, 0x10, b'UI', b'1.2.840.10008.1.2.1')
    meta = element(2, 0, b'UL', struct.pack('<I', len(syntax))) + syntax
    short = lambda number, value: element(0x28, number, b'US', struct.pack('<H', value))
    body = (element(8, 0x60, b'CS', b'OT') + short(2, 1) + element(0x28, 4, b'CS', b'MONOCHROME2') + short(0x10, height)
            + short(0x11, width) + short(0x100, 8) + short(0x101, 8) + short(0x102, 7) + short(0x103, 0)
            + element(0x7fe0, 0x10, b'OB', pixels[::3]))
    return b'\0' * 128 + b'DICM' + meta + body


def main():
    width, height, pixels = read_ppm(sys.argv[1])
    folder = sys.argv[2]
    planes = [pixels[c::3] for c in range(3)]
    # Photoshop keeps its merged picture over white: what is half there is half white.
    over_white = [bytes(round(v * 128 / 255 + 127) for v in plane) for plane in planes]
    half = bytes([128]) * (width * height)
    files = {
        'flat.psd': psd(width, height, planes, 3, False),
        'alpha.psd': psd(width, height, over_white + [half], 3, True),
        'cmyk.psd': psd(width, height, planes + [half], 4, False),
        'flat.dds': dds(width, height, pixels, False),
        'alpha.dds': dds(width, height, pixels, True),
        'flat.pic': softimage(width, height, pixels),
        'log.cin': cineon(width, height, pixels),
        'scan.dcm': dicom(width, height, pixels),
    }
    for name, data in files.items():
        with open(folder + '/' + name, 'wb') as file:
            file.write(data)


if __name__ == '__main__':
    main()
