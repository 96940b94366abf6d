"""What the windows of one session tell one another: what is shown, and how time runs.

The page sends its design's motion once per change, and each window plays it by itself in step: nothing
here is sent while time merely runs. Of everything only the newest is kept, for each window by itself,
so that a slow window is late and holds nobody up.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterable
from time import monotonic
from typing import Annotated, Any

import msgspec
from fastapi import WebSocket

from ..edge.messages import Mailbox, close, first_to_end

LARGEST_SHOWN = 96 * 1024
"""Bytes of a design with its motion; the page's take 12,000."""
LARGEST_TEXT = 1024
MOST_WINDOWS = 16
SEND_INTERVAL = 0.05
"""Seconds after which a window may send its next motion."""

_POLICY, _TOO_BIG = 1008, 1009
_Finite = Annotated[float, msgspec.Meta(ge=-1e9, le=1e9)]
_Row = tuple[_Finite, _Finite, _Finite, _Finite]


class Pole(msgspec.Struct):
    """A placed pole, rad/s."""

    re: _Finite
    im: _Finite


class Pi(msgspec.Struct):
    """One PI controller: V/rad and s."""

    kp: _Finite
    ti: _Finite


class Loops(msgspec.Struct):
    """Both PI controllers."""

    pitch: Pi
    yaw: Pi


class Design(msgspec.Struct):
    """What the panel shows of a design; the rest passes through unread."""

    poles: tuple[Pole, Pole, Pole, Pole]
    loops: Loops
    outer: str = "pi"


class Shown(msgspec.Struct):
    """The header of a frame that shows a design and its motion.

    Attributes:
        design: what was chosen.
        K: the gain that follows.
        after: number of the panel's last message that the design contains.
    """

    design: Design
    K: tuple[_Row, _Row]
    after: int = 0


class Transport(msgspec.Struct, tag="transport", forbid_unknown_fields=True):
    """How time ran in the motion at a moment of the server's clock.

    Attributes:
        playing, loop: whether time runs, and starts again at the end.
        time: in the motion, s; `speed` of them pass in a second.
        at: when that was, s on the server's clock.
    """

    playing: bool
    time: Annotated[float, msgspec.Meta(ge=0, le=1e6)]
    speed: Annotated[float, msgspec.Meta(gt=0, le=100)]
    loop: bool
    at: _Finite


class Sticks(msgspec.Struct, tag="sticks", forbid_unknown_fields=True):
    """What a window that flies along asks for, from −1 to 1: nose up, and nose to the right."""

    pitch: Annotated[float, msgspec.Meta(ge=-1.0, le=1.0)]
    yaw: Annotated[float, msgspec.Meta(ge=-1.0, le=1.0)]


class _Clock(msgspec.Struct, tag="clock", forbid_unknown_fields=True):
    """Asks for the server's time; `sent` comes back as it is."""

    sent: float


_text_decoder = msgspec.json.Decoder(Transport | Sticks | _Clock)
_shown_decoder = msgspec.json.Decoder(Shown)


def read_shown(frame: bytes) -> Shown:
    """Return the header of a frame: uint32 length, JSON, then arrays that nobody here reads.

    Raises:
        msgspec.MsgspecError: if it is none.
    """
    size = int.from_bytes(frame[:4], "little")
    if len(frame) < 4 + size:
        raise msgspec.ValidationError("the frame is shorter than its header says")
    return _shown_decoder.decode(frame[4 : 4 + size])


def encode_message(kind: str, **content: Any) -> str:
    """Return a message to a window as text."""
    return msgspec.json.encode({"type": kind, **content}).decode()


class Window:
    """One member of a room: the page, which has the design, or a window that only shows it."""

    def __init__(self, *, page: bool) -> None:
        self.page = page
        self.sticks = Sticks(0.0, 0.0)
        self._mailbox: Mailbox[tuple[str, str | bytes]] = Mailbox()
        self._edits: dict[str, Any] = {}

    def queue(self, topic: str, message: str | bytes) -> None:
        """Leave a message, in place of one on the same topic that was not sent yet."""
        self._mailbox.put((topic, message), topic)

    def edit(self, edits: dict[str, Any], count: int) -> None:
        """Leave what the panel asks for; of what waits, the newest value of each name stays."""
        self._edits |= edits
        self.queue("panel", encode_message("panel", edits=self._edits, count=count))

    async def send_pending(self, socket: WebSocket) -> None:
        """Send what waits, for as long as the socket takes it."""
        while True:
            topic, message = await self._mailbox.take()
            if topic == "panel":
                self._edits = {}
            await (socket.send_text(message) if isinstance(message, str) else socket.send_bytes(message))


class Room:
    """The windows of one session and the newest of what they share; belongs to one event loop.

    Args:
        on_change: called with the design's header, and with how time runs, whenever they change.
    """

    def __init__(self, on_change: Callable[[Shown | Transport], None] = lambda _: None) -> None:
        self.on_change = on_change
        self.windows: list[Window] = []
        self.shown: Shown | None = None
        self.transport: Transport | None = None
        self._messages: dict[str, str | bytes] = {}
        self._edits = 0

    @property
    def full(self) -> bool:
        """Whether no window may join."""
        return len(self.windows) >= MOST_WINDOWS

    @property
    def edits(self) -> int:
        """How many messages the panel has sent."""
        return self._edits

    @property
    def leader(self) -> Window | None:
        """The window that the panel's edits go to: the first page, or else the first of all."""
        return next((w for w in self.windows if w.page), self.windows[0] if self.windows else None)

    def join(self, window: Window) -> None:
        """Add a window and tell it what is known."""
        self.windows.append(window)
        for topic, message in self._messages.items():
            window.queue(topic, message)
        self._announce_windows()

    def leave(self, window: Window) -> None:
        """Forget a window."""
        self.windows.remove(window)
        if window.sticks != Sticks(0.0, 0.0):
            self.steer(Sticks(0.0, 0.0), window)  # who has gone holds nothing
        self._announce_windows()

    def show(self, frame: bytes, sender: Window) -> None:
        """Take a design with its motion and pass it on.

        Raises:
            msgspec.MsgspecError: if it is none.
        """
        self.shown = read_shown(frame)
        self._broadcast("shown", frame, sender)
        self.on_change(self.shown)

    def set_transport(self, transport: Transport, sender: Window) -> None:
        """Take how time runs and pass it on."""
        self.transport = transport
        self._broadcast("transport", msgspec.json.encode(transport).decode(), sender)
        self.on_change(transport)

    def steer(self, sticks: Sticks, sender: Window) -> None:
        """Pass on what the windows that fly along ask for together."""
        sender.sticks = sticks
        message = encode_message(
            "sticks",
            pitch=_together(window.sticks.pitch for window in self.windows),
            yaw=_together(window.sticks.yaw for window in self.windows),
        )
        for window in self.windows:
            if window is not sender:
                window.queue("sticks", message)

    def edit(self, edits: dict[str, Any]) -> None:
        """Hand on what someone has set at the panel."""
        self._edits += 1
        if self.leader is not None:
            self.leader.edit(edits, self._edits)

    def _broadcast(self, topic: str, message: str | bytes, sender: Window) -> None:
        self._messages[topic] = message
        for window in self.windows:
            if window is not sender:
                window.queue(topic, message)

    def _announce_windows(self) -> None:
        for window in self.windows:
            others = len(self.windows) - 1
            window.queue(
                "windows",
                encode_message("windows", others=others, leads=window is self.leader, count=self._edits),
            )


def _together(asked: Iterable[float]) -> float:
    return min(max(sum(asked), -1.0), 1.0)


async def serve_window(socket: WebSocket, room: Room, window: Window) -> None:
    """Carry messages between an accepted socket and the room until the socket closes."""
    room.join(window)
    try:
        await first_to_end(window.send_pending(socket), _receive(socket, room, window))
    finally:
        room.leave(window)


async def _receive(socket: WebSocket, room: Room, window: Window) -> None:
    loop = asyncio.get_running_loop()
    while True:
        message = await socket.receive()
        if message["type"] == "websocket.disconnect":
            return None
        frame, text = message.get("bytes"), message.get("text")
        if len(frame or text or "") > (LARGEST_SHOWN if frame else LARGEST_TEXT):
            return await close(socket, _TOO_BIG, "this message is too large")
        try:
            if frame:
                room.show(frame, window)
                # The next one is asked for a little later: a sender keeps the newest until then.
                loop.call_later(SEND_INTERVAL, window.queue, "taken", encode_message("taken"))
                continue
            match _text_decoder.decode(text or ""):
                case Transport() as transport:
                    room.set_transport(transport, window)
                case Sticks() as sticks:
                    room.steer(sticks, window)
                case _Clock(sent=sent):
                    window.queue("clock", encode_message("clock", sent=sent, now=monotonic()))
        except msgspec.MsgspecError as error:
            return await close(socket, _POLICY, f"not understood: {error}")
