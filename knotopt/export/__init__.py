"""Flight plans for other programs: waypoints, and what a Crazyflie swarm takes."""
