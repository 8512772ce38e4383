"""Reads an MCAP file according to its specification (https://mcap.dev/spec) and fails at every
deviation from it. Prints each topic's messages as lines of TOPIC, time (ns) and JSON.

    read_mcap.py FILE
"""

import json
import struct
import sys
import zlib

MAGIC = b'\x89MCAP0\r\n'


class Fields:
    """The fields of a record, one after the other."""

    def __init__(self, content):
        self.content, self.at = content, 0

    def number(self, letter):
        value, = struct.unpack_from('<' + letter, self.content, self.at)
        self.at += struct.calcsize('<' + letter)
        return value

    def numbers(self, letters):
        return [self.number(letter) for letter in letters]

    def bytes(self, letter='I'):
        size = self.number(letter)
        assert self.at + size <= len(self.content)
        self.at += size
        return self.content[self.at - size:self.at]

    def text(self):
        return self.bytes().decode('utf-8')

    def pairs(self, letters):
        inner = Fields(self.bytes())
        pairs = []
        while inner.at < len(inner.content):
            pairs.append(tuple(inner.numbers(letters)))
        return pairs

    def rest(self):
        return self.content[self.at:]

    def end(self):
        assert self.at == len(self.content), 'a record is longer than its fields'


def records(data, begin, end):
    """Yields opcode, begin, end and fields of each record."""
    while begin < end:
        op, size = struct.unpack_from('<BQ', data, begin)
        assert begin + 9 + size <= end, 'a record goes on behind its section'
        yield op, begin, begin + 9 + size, Fields(data[begin + 9:begin + 9 + size])
        begin += 9 + size


def message(fields):
    topic, sequence, logged, published = fields.numbers('HIQQ')
    assert logged == published
    return topic, sequence, logged, fields.rest()


def read(data):
    assert data.startswith(MAGIC) and data.endswith(MAGIC)
    footer_size = 9 + 8 + 8 + 4
    footer_at = len(data) - len(MAGIC) - footer_size
    op, _, _, footer = next(records(data, footer_at, len(data) - len(MAGIC)))
    assert op == 0x02
    summary, offsets, crc = footer.numbers('QQI')
    assert crc == zlib.crc32(data[summary:footer_at + footer_size - 4]) != 0

    schemas, channels, messages, chunks, seen, previous = {}, {}, [], {}, [], None
    for op, begin, end, fields in records(data, len(MAGIC), summary):
        seen.append(op)
        if op == 0x01:
            assert begin == len(MAGIC)
            assert fields.text() == '' and fields.text() == 'touchdown'
        elif op == 0x03:
            number = fields.number('H')
            schemas[number] = (fields.text(), fields.text(), fields.bytes())
        elif op == 0x04:
            number, schema = fields.numbers('HH')
            assert schema in schemas
            channels[number] = (schema, fields.text(), fields.text(), fields.bytes())
        elif op == 0x06:
            start, last, size, crc = fields.numbers('QQQI')
            assert fields.text() == ''
            inside = fields.bytes('Q')
            assert size == len(inside) and crc == zlib.crc32(inside) != 0
            here = [(at, message(one)) for kind, at, _, one in records(inside, 0, size)
                    if kind == 0x05 or sys.exit('a chunk holds something else than messages')]
            assert all(topic in channels for _, (topic, *_) in here)
            times = [one[2] for _, one in here]
            assert (start, last) == (min(times), max(times))
            messages += [one for _, one in here]
            previous = begin
            chunks[begin] = [start, last, begin, end - begin, {}, 0, size, dict(here)]
        elif op == 0x07:
            assert seen[-2] in (0x06, 0x07), 'an index that follows no chunk'
            chunk = chunks[previous]
            topic, entries = fields.number('H'), fields.pairs('QQ')
            assert entries == sorted(entries, key=lambda entry: entry[0])
            assert {at for _, at in entries} == {at for at, one in chunk[7].items() if one[0] == topic}
            assert all(chunk[7][at][2] == time for time, at in entries)
            chunk[4][topic] = begin
            chunk[5] += end - begin
        elif op == 0x0F:
            assert end == summary, 'something follows the end of the data'
            assert fields.number('I') == zlib.crc32(data[:begin]) != 0
        else:
            sys.exit(f'opcode {op} in the data')
        if op != 0x05:
            fields.end()
    assert seen[-1] == 0x0F
    for chunk in chunks.values():
        assert set(chunk[4]) == {one[0] for one in chunk[7].values()}

    groups, indexed, again = {}, set(), ({}, {})
    for op, begin, end, fields in records(data, summary, offsets):
        assert op not in groups or groups[op][1] == begin, 'records of a kind are not together'
        groups[op] = (groups.get(op, (begin,))[0], end)
        if op == 0x03:
            number = fields.number('H')
            again[0][number] = (fields.text(), fields.text(), fields.bytes())
        elif op == 0x04:
            number, schema = fields.numbers('HH')
            again[1][number] = (schema, fields.text(), fields.text(), fields.bytes())
        elif op == 0x08:
            start, last, at, size = fields.numbers('QQQQ')
            of_topics = dict(fields.pairs('HQ'))
            index_size = fields.number('Q')
            assert fields.text() == ''
            assert fields.numbers('QQ') == [chunks[at][6]] * 2
            assert [start, last, at, size, of_topics, index_size] == chunks[at][:6]
            indexed.add(at)
        elif op == 0x0B:
            assert 0x04 in groups, 'statistics before the channels'
            times = [one[2] for one in messages] or [0]
            assert fields.numbers('QHIIIIQQ') == [len(messages), len(schemas), len(channels), 0, 0,
                                                  len(chunks), min(times), max(times)]
            counts = dict(fields.pairs('HQ'))
            assert counts == {c: sum(one[0] == c for one in messages) for c in channels}
        else:
            sys.exit(f'opcode {op} in the summary')
        fields.end()
    assert again == (schemas, channels) and indexed == set(chunks)
    listed = {}
    for op, _, end, fields in records(data, offsets, footer_at):
        assert op == 0x0E
        kind, start, size = fields.numbers('BQQ')
        listed[kind] = (start, start + size)
        fields.end()
    assert listed == groups
    for topic in channels:
        numbers = [one[1] for one in messages if one[0] == topic]
        assert numbers == list(range(len(numbers)))
    return schemas, channels, messages


def fits(value, schema):
    """Whether a message matches its schema; null stands for NaN."""
    kind = schema.get('type')
    if kind == 'object':
        return isinstance(value, dict) and all(fits(v, schema['properties'].get(k, {}))
                                               for k, v in value.items())
    if kind == 'array':
        return isinstance(value, list) and all(fits(v, schema['items']) for v in value)
    return isinstance(value, {'number': (int, float, type(None)), 'boolean': bool, 'string': str,
                              None: object}[kind])


def main():
    with open(sys.argv[1], 'rb') as file:
        schemas, channels, messages = read(file.read())
    for topic, _, time, data in messages:
        schema, name, encoding, metadata = channels[topic]
        assert encoding == 'json' and metadata == b'' and schemas[schema][1] == 'jsonschema'
        def no_constant(word):
            sys.exit(f'{word} is no JSON')
        value = json.loads(data, parse_constant=no_constant)
        assert fits(value, json.loads(schemas[schema][2])), (name, value)
        print(name, schemas[schema][0], time, json.dumps(value))


if __name__ == '__main__':
    main()
