// categories and trailing name-value pairs
surface illuminance_category(string category = "key") {
    color c = 0;
    illuminance("key", P, N, PI / 2) { c += Cl; }
    illuminance("-rim", P) { c += Cl * 0.5; }
    illuminance(category, P, N, 1.57, "lightcache", "refresh") { c += Cl * 0.25; }
    Ci = c;
}
