use <MCAD/involute_gears.scad>
gear(number_of_teeth = 11, circular_pitch = 300);
