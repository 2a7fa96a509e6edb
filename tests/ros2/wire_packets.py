"""IP packets as a proxy sees them, cuts and garbles them, and what of RTPS (the wire protocol of DDS) in them is of a goal of an action."""

import struct

UDP = 17
# Submessages and their flags.
DATA, LITTLE, INLINE_QOS, SENTINEL = 0x15, 1, 2, 1
# Bytes of a request after the header of its encapsulation: what identifies it (16), the goal's identity (16), a stamp (8).
RESULT_REQUEST, CANCEL_REQUEST = 32, 40


def is_udp(packet):
    return len(packet) >= 28 and packet[0] >> 4 == 4 and packet[9] == UDP


def is_fragment(packet):
    """Whether it is one of the parts of a datagram."""
    return struct.unpack_from("!H", packet, 6)[0] & 0x3FFF != 0


def header_length(packet):
    return (packet[0] & 15) * 4


def _sum(data):
    if len(data) % 2:
        data += b"\0"
    total = sum(struct.unpack(f"!{len(data) // 2}H", data))
    while total >> 16:
        total = (total & 0xFFFF) + (total >> 16)
    return total ^ 0xFFFF


def with_checksums(packet):
    """The packet with the lengths and checksums of IP and UDP that fit what is in it."""
    packet, at = bytearray(packet), header_length(packet)
    struct.pack_into("!H", packet, 2, len(packet))
    struct.pack_into("!H", packet, 10, 0)
    struct.pack_into("!H", packet, 10, _sum(bytes(packet[:at])))
    struct.pack_into("!HH", packet, at + 4, len(packet) - at, 0)
    pseudo = bytes(packet[12:20]) + struct.pack("!HH", UDP, len(packet) - at)
    struct.pack_into("!H", packet, at + 6, _sum(pseudo + bytes(packet[at:])) or 0xFFFF)
    return bytes(packet)


def garbled(packet, dice, first):
    """The packet with one to eight bits flipped from a byte on."""
    packet = bytearray(packet)
    for _ in range(dice.choice((1, 1, 2, 8))):
        packet[dice.randrange(first, len(packet))] ^= 1 << dice.randrange(8)
    return bytes(packet)


def truncated(packet, dice):
    """The packet, which ends somewhere in its datagram, as one that was sent so."""
    body = header_length(packet) + 8
    return with_checksums(packet[: dice.randrange(body, len(packet))]) if len(packet) > body else packet


def requests(packet):
    """What a client of actions asks for in a packet: `goal` (of a base, or of joints), `result`, `cancel`."""
    found, rtps = [], packet[header_length(packet) + 8 :]
    if rtps[:4] != b"RTPS":
        return found
    at = 20
    while at + 4 <= len(rtps):
        kind, flags = rtps[at], rtps[at + 1]
        order = "<" if flags & LITTLE else ">"
        length = struct.unpack_from(order + "H", rtps, at + 2)[0]
        end = len(rtps) if length == 0 else min(at + 4 + length, len(rtps))
        # Of user-defined writers without a key.
        if kind == DATA and at + 24 <= end and rtps[at + 15] == 3:
            body = _payload(rtps[at + 24 : end], flags, order)
            if len(body) == RESULT_REQUEST:
                found.append("result")
            elif len(body) == CANCEL_REQUEST:
                found.append("cancel")
            elif b"map\0" in body or b"_joint\0" in body:
                found.append("goal")
        at = end
    return found


def _payload(data, flags, order):
    """What comes after the inline quality of service and the header of the encapsulation."""
    if flags & INLINE_QOS:
        at = 0
        while at + 4 <= len(data):
            parameter, length = struct.unpack_from(order + "HH", data, at)
            at += 4 + (0 if parameter == SENTINEL else length)
            if parameter == SENTINEL:
                break
        data = data[at:]
    return data[4:]
