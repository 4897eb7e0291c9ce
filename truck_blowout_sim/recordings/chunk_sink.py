"""Chunks on their way to the disk: gathered under a lock, written by a thread of their own."""

from __future__ import annotations

import threading
from collections.abc import Callable

from truck_blowout_sim.errors import StorageError
from truck_blowout_sim.recordings.chunk import Chunk
from truck_blowout_sim.recordings.mcap_file import McapFile, storage_error

_CHUNK_SIZE = 1 << 20
_MOST_WAITING = 1 << 28


class ChunkSink:
    """Takes messages at any time and writes them in chunks.

    Args:
        file: where they go.
        flush_s: longest wall time that a message waits; None for no thread, then a chunk is
            written when it is large enough, and the file depends on the data alone.

    Attributes:
        accepted: messages taken.
        dropped: messages refused or lost after a storage error.
        error: the first storage error.
    """

    def __init__(self, file: McapFile, flush_s: float | None) -> None:
        self.file = file
        self.accepted = 0
        self.dropped = 0
        self.error: StorageError | None = None
        self._chunk = Chunk()
        self._lock = threading.Lock()
        self._disk_lock = threading.Lock()
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None
        if flush_s is not None:
            self._thread = threading.Thread(
                target=self._drain_regularly, args=(flush_s / 2,), name="bag writer", daemon=True
            )
            self._thread.start()

    @property
    def stopped(self) -> bool:
        """Whether :meth:`stop` was called."""
        return self._stop.is_set()

    def add(self, messages: int, fill: Callable[[Chunk], None]) -> None:
        """Let ``fill`` add that many messages (or descriptions, with 0) to the chunk."""
        with self._lock:
            if self._usable(messages):
                fill(self._chunk)
                self.accepted += messages
        if self._thread is None and self._chunk.size > _CHUNK_SIZE:
            self.drain()

    def drain(self) -> None:
        """Write what has gathered; an error is kept in :attr:`error`, not raised."""
        with self._disk_lock:
            with self._lock:
                chunk, self._chunk = self._chunk, Chunk()
            if chunk.size and self.error is None:
                try:
                    self.file.write_chunk(chunk)
                except OSError as error:  # any: nobody hears what ends the writer's thread
                    saved = f"{self.file.contents.message_count} messages saved before that"
                    self.error = storage_error(self.file.path, error, saved)
                    self.dropped += chunk.message_count

    def stop(self) -> None:
        """End the thread and write the rest."""
        self._stop.set()
        if self._thread:
            self._thread.join()
        self.drain()

    def _usable(self, messages: int) -> bool:
        if self._chunk.size > _MOST_WAITING and self.error is None:
            words = f"the disk is too slow: {self._chunk.size >> 20} MiB wait to be written"
            self.error = StorageError(words, file=self.file.path)
        if self.error is not None:
            self.dropped += messages
        return self.error is None

    def _drain_regularly(self, period_s: float) -> None:
        while not self._stop.wait(period_s):
            self.drain()
