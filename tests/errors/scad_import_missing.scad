import("nowhere.stl");
