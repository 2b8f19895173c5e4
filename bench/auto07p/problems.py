"""The branches as AUTO-07p reads them: equations with analytic derivatives, constants, windows.

branches.cpp states the same equations, windows and starts for Arcslip.
"""

from dataclasses import dataclass

# Detection of folds only, no output but the line of each point in fort.7: no solutions (NPR, IIS = 0), no
# diagnostics (IID = 0). EPSL, EPSU, EPSS are those of the manual's demos; Arcslip's corrector stops at a
# correction of 1e-9.
CONSTANTS = """\
NDIM={ndim}, IPS={ips}, IRS=0, ILP=1, ISP=0, ISW=1, IPLT=0
ICP=[1], NPAR={npar}
NTST={ntst}, NCOL=4, IAD=3, NBC={nbc}, NINT=0
NMX=10000000, RL0={lower}, RL1={upper}, A0=-1e30, A1=1e30
NPR=0, MXBF=0, IIS=0, IID=0, ITMX=8, ITNW=5, NWTN=3, JAC=1
EPSL=1e-7, EPSU=1e-7, EPSS=1e-5
DS={ds}, DSMIN=1e-9, DSMAX={dsmax}, IADS=1
"""

FUNC = """\
SUBROUTINE FUNC(NDIM,U,ICP,PAR,IJAC,F,DFDU,DFDP)
  IMPLICIT NONE
  INTEGER, INTENT(IN) :: NDIM, ICP(*), IJAC
  DOUBLE PRECISION, INTENT(IN) :: U(NDIM), PAR(*)
  DOUBLE PRECISION, INTENT(OUT) :: F(NDIM)
  DOUBLE PRECISION, INTENT(INOUT) :: DFDU(NDIM,NDIM), DFDP(NDIM,*)
{declarations}
{residual}
  IF (IJAC == 0) RETURN
{jacobian}
  IF (IJAC == 1) RETURN
{derivative}
END SUBROUTINE FUNC
SUBROUTINE STPNT(NDIM,U,PAR,T)
  IMPLICIT NONE
  INTEGER, INTENT(IN) :: NDIM
  DOUBLE PRECISION, INTENT(INOUT) :: U(NDIM), PAR(*)
  DOUBLE PRECISION, INTENT(IN) :: T
{start}
END SUBROUTINE STPNT
"""

UNUSED = "SUBROUTINE {0}\nEND SUBROUTINE {0}\n"


@dataclass
class Case:
    name: str  # in the table
    arcslip: str  # the branch of arcslip_branches
    ndim: int
    window: tuple
    dsmax: float  # for 100 to 300 points
    residual: str
    jacobian: str
    derivative: str
    start: str
    declarations: str = ""
    npar: int = 1
    ips: int = 0
    ntst: int = 1
    finer: float = 0.1  # steps of the second run, of those of the first: it takes well over AUTO's start
    boundary: str = ""  # BCND, of a boundary value problem

    def equations(self):
        parts = [FUNC.format(**vars(self)), self.boundary or UNUSED.format("BCND")]
        return "".join(parts + [UNUSED.format(name) for name in ("ICND", "FOPT", "PVLS")])

    def constants(self, refinement):
        """All steps `refinement` times as long."""
        return CONSTANTS.format(ndim=self.ndim, ips=self.ips, npar=self.npar, ntst=self.ntst,
                                nbc=self.ndim if self.boundary else 0, lower=self.window[0] - 1e-9,
                                upper=self.window[1], ds=self.dsmax * refinement / 3,
                                dsmax=self.dsmax * refinement)


CUSP = Case(
    name="cusp", arcslip="cusp", ndim=1, npar=2, window=(-2, 2), dsmax=0.03, finer=0.01,
    residual="  F(1) = PAR(1) + PAR(2)*U(1) - U(1)*U(1)*U(1)",
    jacobian="  DFDU(1,1) = PAR(2) - 3*U(1)*U(1)",
    derivative="  DFDP(1,1) = 1\n  DFDP(1,2) = U(1)",
    start="  PAR(1) = -2\n  PAR(2) = 1\n  U(1) = -1.5213797068045676D0")

AB = Case(
    name="ab", arcslip="ab", ndim=2, npar=3, window=(0, 0.15), dsmax=0.04, finer=0.01,
    declarations="  DOUBLE PRECISION E, R",
    residual="""\
  R = PAR(1)*(1 - U(1))*EXP(U(2))
  F(1) = -U(1) + R
  F(2) = -U(2) + PAR(2)*R - PAR(3)*U(2)""",
    jacobian="""\
  E = PAR(1)*EXP(U(2))
  DFDU(1,1) = -1 - E
  DFDU(1,2) = R
  DFDU(2,1) = -PAR(2)*E
  DFDU(2,2) = -1 + PAR(2)*R - PAR(3)""",
    derivative="""\
  E = (1 - U(1))*EXP(U(2))
  DFDP(1,1) = E
  DFDP(2,1) = PAR(2)*E
  DFDP(1,2) = 0
  DFDP(2,2) = PAR(1)*E
  DFDP(1,3) = 0
  DFDP(2,3) = -U(2)""",
    start="  PAR(1:3) = (/ 0D0, 14D0, 2D0 /)\n  U(1:2) = 0")

FREUDENSTEIN_ROTH = Case(
    name="Freudenstein-Roth", arcslip="freudenstein_roth", ndim=2, window=(-1, 1.5), dsmax=0.6, finer=0.01,
    declarations="  DOUBLE PRECISION Y",
    residual="""\
  Y = U(2)
  F(1) = U(1) + ((5 - Y)*Y - 2)*Y - 13 + 34*(PAR(1) - 1)
  F(2) = U(1) + ((1 + Y)*Y - 14)*Y - 29 + 10*(PAR(1) - 1)""",
    jacobian="""\
  DFDU(1,1) = 1
  DFDU(2,1) = 1
  DFDU(1,2) = (10 - 3*Y)*Y - 2
  DFDU(2,2) = (2 + 3*Y)*Y - 14""",
    derivative="  DFDP(1,1) = 34\n  DFDP(2,1) = 10",
    start="  PAR(1) = 0\n  U(1) = 15\n  U(2) = -2")

CHAN = Case(
    name="chan, n = 100", arcslip="chan", ndim=100, window=(0, 5), dsmax=1.0,
    declarations="  INTEGER I\n  DOUBLE PRECISION H2, T, D",
    residual="""\
  H2 = 1D0/(NDIM - 1)**2
  F(1) = U(1)
  F(NDIM) = U(NDIM)
  DO I = 2, NDIM - 1
    T = U(I)
    F(I) = U(I-1) - 2*T + U(I+1) + PAR(1)*H2*(1 + (T + T*T/2)/(1 + T*T/100))
  END DO""",
    jacobian="""\
  DFDU = 0
  DFDU(1,1) = 1
  DFDU(NDIM,NDIM) = 1
  DO I = 2, NDIM - 1
    T = U(I)
    D = 1 + T*T/100
    DFDU(I,I-1) = 1
    DFDU(I,I+1) = 1
    DFDU(I,I) = -2 + PAR(1)*H2*((1 + T)*D - (T + T*T/2)*T/50)/(D*D)
  END DO""",
    derivative="""\
  DFDP(1,1) = 0
  DFDP(NDIM,1) = 0
  DO I = 2, NDIM - 1
    T = U(I)
    DFDP(I,1) = H2*(1 + (T + T*T/2)/(1 + T*T/100))
  END DO""",
    start="  PAR(1) = 0\n  U = 0")

# The periodic response over one period, scaled to 1, as a boundary value problem: U = (x, x', t/T).
DUFFING = Case(
    name="Duffing", arcslip="duffing/7", ndim=3, window=(0.5, 1.6), dsmax=0.02, ips=4, ntst=20,
    declarations="  DOUBLE PRECISION, PARAMETER :: TWO_PI = 6.283185307179586D0\n  DOUBLE PRECISION T, A",
    residual="""\
  T = TWO_PI/PAR(1)
  A = -0.1D0*U(2) - U(1) - U(1)*U(1)*U(1) + 0.1D0*COS(TWO_PI*U(3))
  F(1) = T*U(2)
  F(2) = T*A
  F(3) = 1""",
    jacobian="""\
  DFDU = 0
  DFDU(1,2) = T
  DFDU(2,1) = -T*(1 + 3*U(1)*U(1))
  DFDU(2,2) = -0.1D0*T
  DFDU(2,3) = -0.1D0*T*TWO_PI*SIN(TWO_PI*U(3))""",
    derivative="""\
  DFDP(1,1) = -F(1)/PAR(1)
  DFDP(2,1) = -F(2)/PAR(1)
  DFDP(3,1) = 0""",
    start="""\
  PAR(1) = 0.5D0
  U(1) = 0.13274336D0*COS(6.283185307179586D0*T) + 0.00884956D0*SIN(6.283185307179586D0*T)
  U(2) = -0.06637168D0*SIN(6.283185307179586D0*T) + 0.00442478D0*COS(6.283185307179586D0*T)
  U(3) = T""",
    boundary="""\
SUBROUTINE BCND(NDIM,PAR,ICP,NBC,U0,U1,FB,IJAC,DBC)
  IMPLICIT NONE
  INTEGER, INTENT(IN) :: NDIM, ICP(*), NBC, IJAC
  DOUBLE PRECISION, INTENT(IN) :: PAR(*), U0(NDIM), U1(NDIM)
  DOUBLE PRECISION, INTENT(OUT) :: FB(NBC)
  DOUBLE PRECISION, INTENT(INOUT) :: DBC(NBC,*)
  FB(1:2) = U0(1:2) - U1(1:2)
  FB(3) = U0(3)
  IF (IJAC == 0) RETURN
  DBC(:,1:6) = 0
  DBC(1,1) = 1
  DBC(2,2) = 1
  DBC(3,3) = 1
  DBC(1,4) = -1
  DBC(2,5) = -1
  IF (IJAC == 1) RETURN
  DBC(:,7) = 0
END SUBROUTINE BCND
""")

CASES = [CUSP, AB, FREUDENSTEIN_ROTH, CHAN, DUFFING]
