class class_local_struct(uniform float seed = 3)
{
    struct Cell { point centre; float f1; uniform float id; }
    Cell m_cell;
    void nearest(point p; output Cell cell)
    {
        point base = point(floor(xcomp(p)) + .5, floor(ycomp(p)) + .5, floor(zcomp(p)) + .5);
        float i, j, k;
        cell->f1 = 1000;
        for (i = -1; i <= 1; i += 1)
            for (j = -1; j <= 1; j += 1)
                for (k = -1; k <= 1; k += 1) {
                    point testcell = base + vector(i, j, k);
                    point pos = testcell + vector cellnoise(testcell + seed) - .5;
                    float d = distance(pos, p);
                    if (d < cell->f1) { cell->f1 = d; cell->centre = pos; }
                }
    }
    public void begin() { nearest(4 * transform("object", P), m_cell); }
    public void surface(output color Ci, Oi)
    {
        Oi = Os;
        Ci = Oi * color cellnoise(m_cell->centre) * (1 - m_cell->f1);
    }
}
