// Compiles lib/precompiled.hpp for the rooms.
