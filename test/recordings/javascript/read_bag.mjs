// Reads an MCAP file as a JavaScript viewer does: by its index, messages decoded by their embedded
// definitions. Prints, per topic, the number of messages and the first one.
import { open } from "node:fs/promises";
import { McapIndexedReader } from "@mcap/core";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { decompress } from "fzstd";

const handle = await open(process.argv[2], "r");
const size = BigInt((await handle.stat()).size);
const readable = {
  size: async () => size,
  read: async (offset, length) => {
    const bytes = new Uint8Array(Number(length));
    await handle.read(bytes, 0, bytes.length, Number(offset));
    return bytes;
  },
};
const zstd = (bytes, unpacked) => decompress(bytes, new Uint8Array(Number(unpacked)));
const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers: { zstd } });

const decoders = new Map();
const topics = {};
for await (const message of reader.readMessages()) {
  const channel = reader.channelsById.get(message.channelId);
  if (!decoders.has(channel.id)) {
    const schema = reader.schemasById.get(channel.schemaId);
    const definition = parse(new TextDecoder().decode(schema.data), { ros2: true });
    decoders.set(channel.id, new MessageReader(definition));
  }
  const decoded = decoders.get(channel.id).readMessage(message.data);
  topics[channel.topic] ??= { count: 0, first: decoded };
  topics[channel.topic].count += 1;
}
const plain = (key, value) =>
  ArrayBuffer.isView(value) ? Array.from(value) : typeof value === "bigint" ? Number(value) : value;
console.log(JSON.stringify(topics, plain));
await handle.close();
