package Modelica "Stands in for the standard library: its names and equations, friction smoothed"
  package Blocks
    package Interfaces
      connector RealInput = input Real;
    end Interfaces;
  end Blocks;
  package Mechanics
    package Rotational
      package Interfaces
        connector Flange_a
          Real phi;
          flow Real tau;
        end Flange_a;
        connector Flange_b
          Real phi;
          flow Real tau;
        end Flange_b;
        partial model Friction "By the slip, straight to its full torque at a slip of w_small"
          parameter Real fn_max;
          parameter Real cgeo = 1;
          parameter Real mu_pos[:, 2] = [0, 0.5];
          parameter Real peak = 1;
          parameter Real w_small = 1e-4;
          input Modelica.Blocks.Interfaces.RealInput f_normalized;
          Real slip;
          Real tau;
        equation
          tau = cgeo*mu_pos[1, 2]*fn_max*f_normalized*tanh(slip/w_small);
        end Friction;
      end Interfaces;
      package Components
        model Fixed
          Interfaces.Flange_b flange;
        equation
          flange.phi = 0;
        end Fixed;
        model Inertia
          parameter Real J;
          Interfaces.Flange_a flange_a;
          Interfaces.Flange_b flange_b;
          Real phi;
          Real w;
          Real a;
        equation
          phi = flange_a.phi;
          phi = flange_b.phi;
          w = der(phi);
          a = der(w);
          J*a = flange_a.tau + flange_b.tau;
        end Inertia;
        model IdealGear
          parameter Real ratio;
          Interfaces.Flange_a flange_a;
          Interfaces.Flange_b flange_b;
        equation
          flange_a.phi = ratio*flange_b.phi;
          0 = ratio*flange_a.tau + flange_b.tau;
        end IdealGear;
        model IdealPlanetary
          parameter Real ratio;
          Interfaces.Flange_a sun;
          Interfaces.Flange_a carrier;
          Interfaces.Flange_b ring;
        equation
          (1 + ratio)*carrier.phi = sun.phi + ratio*ring.phi;
          ring.tau = ratio*sun.tau;
          carrier.tau = -(1 + ratio)*sun.tau;
        end IdealPlanetary;
        model SpringDamper
          parameter Real c;
          parameter Real d;
          Interfaces.Flange_a flange_a;
          Interfaces.Flange_b flange_b;
          Real phi_rel;
          Real w_rel;
          Real tau;
        equation
          phi_rel = flange_b.phi - flange_a.phi;
          w_rel = der(phi_rel);
          tau = c*phi_rel + d*w_rel;
          flange_b.tau = tau;
          flange_a.tau = -tau;
        end SpringDamper;
        model Clutch
          extends Interfaces.Friction;
          Interfaces.Flange_a flange_a;
          Interfaces.Flange_b flange_b;
        equation
          slip = der(flange_b.phi) - der(flange_a.phi);
          flange_b.tau = tau;
          flange_a.tau = -tau;
        end Clutch;
        model Brake
          extends Interfaces.Friction;
          Interfaces.Flange_a flange_a;
          Interfaces.Flange_b flange_b;
        equation
          flange_a.phi = flange_b.phi;
          slip = der(flange_a.phi);
          flange_a.tau + flange_b.tau = tau;
        end Brake;
        model OneWayClutch "Its flange_b may not turn backward against its flange_a"
          parameter Real fn_max;
          input Modelica.Blocks.Interfaces.RealInput f_normalized;
          Interfaces.Flange_a flange_a;
          Interfaces.Flange_b flange_b;
          Real w_rel;
          Real tau;
        equation
          w_rel = der(flange_b.phi) - der(flange_a.phi);
          tau = if w_rel > 0 then 0 else 1e7*w_rel;
          flange_b.tau = tau;
          flange_a.tau = -tau;
        end OneWayClutch;
      end Components;
      package Sources
        model Torque
          input Modelica.Blocks.Interfaces.RealInput tau;
          Interfaces.Flange_b flange;
        equation
          flange.tau = -tau;
        end Torque;
        model ConstantTorque
          parameter Real tau_constant;
          Interfaces.Flange_b flange;
        equation
          flange.tau = -tau_constant;
        end ConstantTorque;
      end Sources;
    end Rotational;
  end Mechanics;
end Modelica;
