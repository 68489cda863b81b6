// Reads a recording with MCAP's reference reader, checksums, index and all, and prints its messages, one as JSON a line:
//   node read_mcap.mjs FILE
import {McapIndexedReader, McapStreamReader} from '@mcap/core';
import {open, readFile} from 'node:fs/promises';

const path = process.argv[2];
const streamed = new McapStreamReader({validateCrcs: true});
streamed.append(await readFile(path));
let count = 0;
for (let record; (record = streamed.nextRecord());) if (record.type === 'Message') ++count;
if (!streamed.done()) throw new Error('the file does not end');

const file = await open(path);
const readable = {
  size: async () => BigInt((await file.stat()).size),
  read: async (offset, length) => {
    const buffer = new Uint8Array(Number(length));
    await file.read(buffer, 0, Number(length), Number(offset));
    return buffer;
  },
};
const reader = await McapIndexedReader.Initialize({readable});
if (reader.statistics.messageCount !== BigInt(count)) throw new Error('statistics and messages differ');
const text = new TextDecoder();
for (const schema of reader.schemasById.values()) {
  if (schema.encoding !== 'jsonschema' || JSON.parse(text.decode(schema.data)).type !== 'object') throw new Error(`schema ${schema.name}`);
}
let indexed = 0;
for await (const message of reader.readMessages({validateCrcs: true})) {
  const channel = reader.channelsById.get(message.channelId);
  if (!reader.schemasById.has(channel.schemaId) || channel.messageEncoding !== 'json') throw new Error(`channel ${channel.topic}`);
  console.log(JSON.stringify({topic: channel.topic, time_ns: String(message.logTime), event: JSON.parse(text.decode(message.data))}));
  ++indexed;
}
if (indexed !== count) throw new Error('index and messages differ');
await file.close();
