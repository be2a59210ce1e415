class sky_solar(float intensity = 1; uniform color sun = color (1, .9, .8); uniform vector direction = vector "world" (0, -1, 0.3))
{
    public void light(output vector L; output color Cl)
    {
        solar(direction, 0)
        {
            Cl = intensity * sun;
        }
    }
}
