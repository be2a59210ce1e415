class
matteclass
(
	float Ka = 1;
	float Kd = 1;
)
{
	public
	void
	surface
	(
		output color Ci;
		output color Oi;
	)
	{
		extern normal N;
		extern vector I;
		normal Nf = faceforward( normalize(N), I );
		Oi = Os;
		Ci = Os * Cs * ( Ka*ambient() + Kd*diffuse(Nf) );
	}
}
