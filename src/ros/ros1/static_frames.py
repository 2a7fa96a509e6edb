"""Still frames of several publishers, as one message.

Who comes later gets only the last message of `/tf_static` from each publisher, and a bridge is one publisher."""


class StaticFrames:
    """The still frames that each publisher has told last."""

    def __init__(self):
        self.told = {}

    def hear(self, publisher, transforms):
        """A publisher tells frames. Those that it has told before stay, as tf has it."""
        frames = self.told.setdefault(publisher, {})
        frames.update((transform.child_frame_id, transform) for transform in transforms)

    def keep(self, publishers):
        """Forgets the frames of those who are gone; whether there were any."""
        gone = set(self.told) - set(publishers)
        for publisher in gone:
            del self.told[publisher]
        return bool(gone)

    def merged(self):
        """All frames, each once. Of two that say something of one frame, the later one is right."""
        frames = {}
        for told in self.told.values():
            frames.update(told)
        return list(frames.values())
