"""What surrounds every request and socket: who may ask, from where, how much, and what is noted of it."""
